(* Section 4: bodies that are uniquely determined, as a program: a graph is solvable. Of the rules of Theorem 4.1 it takes
   an edge, a node that is joined to two of the nodes before it (rules 2 and 3), and pairs of nodes of an earlier body
   (rule 4). *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From Viewcert Require Import Statement Skew Motions Generic Counting Rigid Checker Generically Unique.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

(* ------------------------------------------------------------------ the program *)
Section Program.
Variables (n m : nat) (first second : nat -> nat) (bodies : nat -> body) (sure : nat -> bool).

Section Body.
Variables (allowed : nat -> nat -> reason -> bool) (B : body).
Fixpoint joined_twice (s d : nat) : bool :=
  if d is d'.+1 then
    match joins B s with
    | [:: (t, why); (t', why')] =>
      if t < s then
        if t' < s then
          if eqn t t' then false
          else if allowed (node B s) (node B t) why then
            if allowed (node B s) (node B t') why' then joined_twice s.+1 d' else false
          else false
        else false
      else false
    | _ => false
    end
  else true.
Definition begins : bool :=
  match joins B 1 with
  | [:: (t, why)] => if eqn t 0 then allowed (node B 1) (node B 0) why else false
  | _ => false
  end.
Definition determined : bool :=
  if 1 < body_size B then
    if eqn (core_size B) 0 then
      if nodes_ok n B (body_size B) then
        if increasing (body_size B) (by_node B) (node B) (body_size B) then
          if begins then joined_twice 2 (body_size B - 2) else false
        else false
      else false
    else false
  else false.
End Body.

(* Those of the bodies 0 .. b-1 that are said to be uniquely determined are. *)
Fixpoint all_determined (b : nat) : bool :=
  if b is b'.+1 then
    if sure b' then
      if determined (pair_ok m first second bodies sure b') (bodies b') then all_determined b' else false
    else all_determined b'
  else true.

(* Body b is, and holds all nodes. *)
Definition solvable_ok (b : nat) : bool :=
  if sure b then if eqn (body_size (bodies b)) n then all_determined b.+1 else false else false.
End Program.

(* ------------------------------------------------------------------ its soundness *)
Import GRing.Theory.
Local Open Scope ring_scope.

Section Sound.
Variables (n m : nat) (first second : nat -> nat) (bodies : nat -> body) (sure : nat -> bool).
Local Notation G := (pairs m first second).
Hypothesis good : well_formed n G.
Local Notation V := (V good).
Local Notation nodes := (nodes bodies good).
Variables (F : numFieldType) (P Q : cameras F n).
Hypotheses (niceP : no_three_on_a_line P) (rankQ : forall v, \rank (cam Q v) = 3%N).
Hypothesis same : same_matrices (edges n G) P Q.

Lemma same_edge e : e \in edges n G -> same_cameras P Q [:: e.1; e.2].
Proof.
case: e => i j eG; have ij : i != j.
  have [k km [-> ->]] := edges_V good eG; have := valV good; case/and3P: good => _ /allP lt _ vV.
  have kG : (first k, second k) \in G by apply: map_f; rewrite mem_iota.
  have /andP [/= fs sn] := lt _ kG; apply/eqP=> /(congr1 val); rewrite !vV // ?(ltn_trans fs) // => e.
  by rewrite e ltnn in fs.
have [rows funds _] := niceP; have [t t0 st] := same eG.
have free v : row_free (cam Q v) by rewrite /row_free rankQ.
have two0 : 2%:R != 0 :> F by rewrite Num.Theory.pnatr_eq0.
have [H u [ei [k k0 ej]]] := rule_1 two0 (rows i) (rows j) (free i) (free j) (funds _ _ ij) t0 st.
exists H => // v; rewrite !inE => /orP [] /eqP -> /=; [by exists 1; rewrite ?oner_neq0 // scale1r | by exists k].
Qed.

Lemma same_turned i j : same_cameras P Q [:: i; j] -> same_cameras P Q [:: j; i].
Proof. by apply: same_sub => v; rewrite !inE orbC. Qed.

Section Body.
Variable b : nat.
Hypothesis before : forall c, (c < b)%N -> sure c -> same_cameras P Q (nodes c).

Lemma allowedP x y why : pair_ok m first second bodies sure b x y why -> same_cameras P Q [:: V x; V y].
Proof.
case: why => [k | c s t | //] /=.
  case: ifP => // /(edge_of good) /same_edge /= kE; case: eqnP => [<- /eqnP <- // | _].
  by case: eqnP => // <- /eqnP <-; apply: same_turned.
case: ifP => // cb; case: ifP => // /(before cb) h; case: ifP => // sc; case: ifP => // tc.
case: eqnP => // <- /eqnP <-; apply: same_sub h => v; rewrite !inE.
by case/orP=> /eqP ->; apply: map_f; rewrite mem_iota.
Qed.

Lemma determinedP : determined n (pair_ok m first second bodies sure b) (bodies b) -> same_cameras P Q (nodes b).
Proof.
rewrite /determined; set B := bodies b; case: ifP => // s1; case: ifP => // _; case: ifP => // /nodes_okP lt.
case: ifP => // /increasingP u; case: ifP => //; rewrite /begins.
have inj i j : (i < body_size B)%N -> (j < body_size B)%N -> i != j -> V (node B i) != V (node B j).
  by move=> iB jB; apply: contra => /eqP /(N_inj u lt iB jB) ->.
case: (joins B 1) => [|[t why] [|//]] //; case: eqnP => // _ /allowedP base two.
have start : same_cameras P Q (mkseq (fun i => V (node B i)) 2) by exact: same_turned.
move: two.
suff grow d s : (1 < s)%N -> (s + d <= body_size B)%N -> same_cameras P Q (mkseq (fun i => V (node B i)) s) ->
    joined_twice (pair_ok m first second bodies sure b) B s d -> same_cameras P Q (mkseq (fun i => V (node B i)) (s + d)).
  by have := grow (body_size B - 2)%N 2%N isT; rewrite subnKC // => /(_ (leqnn _) start).
elim: d s => [|d ih] s s2 le h /=; first by rewrite addn0.
clear t why base start; case: (joins B s) => [|[t why] [|[t' why'] [|//]]] //.
case: ifP => // ts; case: ifP => // ts'; case: eqnP => // tt.
case: ifP => // /allowedP a1; case: ifP => // /allowedP a2.
have sB : (s < body_size B)%N by apply: leq_trans le; rewrite addnS ltnS leq_addr.
rewrite addnS -addSn; apply: ih; [exact: ltnW | by rewrite addSnnS |].
have [rows _ lines] := niceP.
have tB := ltn_trans ts sB; have tB' := ltn_trans ts' sB.
apply: same_sub (rule_3 (a := V (node B t)) (c := V (node B t')) _ _ (rows _) (rows _) (rows (V (node B s))) _ h a1 a2).
- by move=> v; rewrite mkseqS mem_rcons.
- by apply: map_f; rewrite mem_iota.
- by apply: map_f; rewrite mem_iota.
- by apply: lines; apply: inj => //; [exact/eqP | rewrite neq_ltn ts | rewrite neq_ltn ts'].
Qed.
End Body.

Lemma all_determinedP b : all_determined n m first second bodies sure b ->
  forall c, (c < b)%N -> sure c -> same_cameras P Q (nodes c).
Proof.
elim: b => //= b ih; case: ifP => [sb | nb].
  case: ifP => // det /ih before c; rewrite ltnS leq_eqVlt => /predU1P [-> _ | /before //].
  exact: determinedP before det.
by move/ih => before c; rewrite ltnS leq_eqVlt => /predU1P [->|/before //]; rewrite nb.
Qed.

(* Corollary 4.2: at all cameras with centres of which no three are on a line, not only at generic ones *)
Theorem corollary_4_2 b : solvable_ok n m first second bodies sure b -> same_cameras P Q (enum 'I_n).
Proof.
rewrite /solvable_ok; case: ifP => // sb; case: eqnP => // size_n all_b.
have h := all_determinedP all_b (ltnSn b) sb.
apply: same_sub h => v _; move: all_b; rewrite /= sb; case: ifP => // + _.
rewrite /determined; case: ifP => // _; case: ifP => // _; case: ifP => // /nodes_okP lt; case: ifP => // /increasingP u _.
have un : uniq (nodes b).
  rewrite map_inj_in_uniq ?iota_uniq // => i j; rewrite !mem_iota => /= ib jb; exact: (N_inj u lt).
have sub : {subset nodes b <= enum 'I_n} by move=> x _; rewrite mem_enum.
have := uniq_min_size un sub; rewrite size_mkseq size_n size_enum_ord leqnn => /(_ isT) [_ all_].
by rewrite all_ mem_enum.
Qed.
End Sound.

Theorem verify_solvable n m first second by_pair bodies sure b :
  graph_ok n m first second by_pair -> solvable_ok n m first second bodies sure b -> solvable n (pairs m first second).
Proof.
move=> /graph_ok_sound good ok; split=> //; have [q nz h] := generic_cameras n.
by exists q => // F P nzq Q rankQ same; exact: (corollary_4_2 good (h F P nzq) rankQ same ok).
Qed.
