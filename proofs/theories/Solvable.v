(* Sections 4 and 10: bodies that are uniquely determined, as a program: a graph is solvable. Of the rules of Theorem 4.1 it
   takes an edge, a node that is joined to two of the nodes before it (rules 2 and 3), and pairs of nodes of an earlier body
   (rule 4); a body may begin with a core whose scales are settled by Theorem 10.6. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From Viewcert Require Import Statement Skew Motions Generic Counting Rigid Cores Checker Generically Unique Scales.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

(* Why the scales of a core are one: centres of nodes, links of a tree, and what is settled one after the other *)
Record scales := Scales { centre_at : nat -> nat -> nat; tree : nat -> link; steps : seq step }.

(* ------------------------------------------------------------------ the program *)
Section Program.
Variables (n m : nat) (first second : nat -> nat) (bodies : nat -> body) (sure : nat -> bool) (settled_by : nat -> scales).

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
(* what has to be shown of the core of a body, if there is one *)
Definition core_demands (S : scales) : option (seq demand) :=
  let C := core_size B in
  if eqn C 0 then Some [::]
  else if 1 < C then
    if C <= body_size B then
      match by_ (tree S 1) with
      | Direct _ _ =>
        if tree_ok n allowed C (node B) (tree S) C then demands n allowed C (node B) (hanging (tree S) C) (steps S) else None
      | _ => None
      end
    else None
  else None.
Definition determined (S : scales) : bool :=
  if 1 < body_size B then
    if nodes_ok n B (body_size B) then
      if increasing (body_size B) (by_node B) (node B) (body_size B) then
        if core_demands S is Some D then
          if all_shown (core_size B) (node B) the_prime (centre_at S) D then
            if eqn (core_size B) 0 then if begins then joined_twice 2 (body_size B - 2) else false
            else joined_twice (core_size B) (body_size B - core_size B)
          else false
        else false
      else false
    else false
  else false.
End Body.

(* Those of the bodies 0 .. b-1 that are said to be uniquely determined are. *)
Fixpoint all_determined (b : nat) : bool :=
  if b is b'.+1 then
    if sure b' then
      if determined (pair_ok m first second bodies sure b') (bodies b') (settled_by b') then all_determined b' else false
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
Variables (n m : nat) (first second : nat -> nat) (bodies : nat -> body) (sure : nat -> bool) (settled_by : nat -> scales).
Local Notation G := (pairs m first second).
Hypothesis good : well_formed n G.
Local Notation V := (V good).
Local Notation nodes := (nodes bodies good).
Local Notation ok b := (pair_ok m first second bodies sure b).

(* the ranks that are asked for hold at cameras *)
Definition ranks_hold (F : numFieldType) (P : cameras F n) b : Prop :=
  if core_demands n (ok b) (bodies b) (settled_by b) is Some D then every (holds V (core_size (bodies b)) (node (bodies b)) P) D else True.

Lemma determined_generic b : determined n (ok b) (bodies b) (settled_by b) -> @generically n (3 * 4) (fun F P => ranks_hold P b).
Proof.
rewrite /determined /ranks_hold; set B := bodies b; case: ifP => // _; case: ifP => // /nodes_okP lt; case: ifP => // _.
case E: core_demands => [D|//]; case: ifP => // shown _; move: E; rewrite /core_demands; case: eqnP => [_ [<-]|_].
  exact: generically_true.
case: ifP => // C1; case: ifP => // CB; case: by_ => // _ _; case: ifP => // tok E.
have nodes_lt i : (i < core_size B)%N -> (node B i < n)%N by move=> iC; apply: lt; exact: leq_trans CB.
apply: (demands_generic (valV good) nodes_lt the_prime_is_prime _ shown).
exact: demands_fine (hanging_fine tok) E.
Qed.

Lemma all_determined_generic b : all_determined n m first second bodies sure settled_by b ->
  @generically n (3 * 4) (fun F P => forall c, (c < b)%N -> sure c -> ranks_hold P c).
Proof.
elim: b => [_|b ih] /=; first exact: generically_true.
case: ifP => [sb | nb].
  case: ifP => // /determined_generic h /ih rest; apply: generically_impl (generically_and h rest) => F P [hb hc] c.
  by rewrite ltnS leq_eqVlt => /predU1P [-> | /hc].
move/ih; apply: generically_impl => F P hc c.
by rewrite ltnS leq_eqVlt => /predU1P [->|/hc //]; rewrite nb.
Qed.

Section Given.
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
Hypotheses (before : forall c, (c < b)%N -> sure c -> same_cameras P Q (nodes c)) (ranks : ranks_hold P b).

Lemma allowedP x y why : pair_ok m first second bodies sure b x y why -> same_cameras P Q [:: V x; V y].
Proof.
case: why => [k | c s t | //] /=.
  case: ifP => // /(edge_of good) /same_edge /= kE; case: eqnP => [<- /eqnP <- // | _].
  by case: eqnP => // <- /eqnP <-; apply: same_turned.
case: ifP => // cb; case: ifP => // /(before cb) h; case: ifP => // sc; case: ifP => // tc.
case: eqnP => // <- /eqnP <-; apply: same_sub h => v; rewrite !inE.
by case/orP=> /eqP ->; apply: map_f; rewrite mem_iota.
Qed.

Section Grow.
Local Notation B := (bodies b).
Hypotheses (lt : forall i, (i < body_size B)%N -> (node B i < n)%N) (u : uniq (mkseq (node B) (body_size B))).
Lemma V_neq i j : (i < body_size B)%N -> (j < body_size B)%N -> i != j -> V (node B i) != V (node B j).
Proof. by move=> iB jB; apply: contra => /eqP /(N_inj u lt iB jB) ->. Qed.

Lemma joined_twiceP d s : (1 < s)%N -> (s + d <= body_size B)%N -> same_cameras P Q (mkseq (fun i => V (node B i)) s) ->
  joined_twice (ok b) B s d -> same_cameras P Q (mkseq (fun i => V (node B i)) (s + d)).
Proof.
elim: d s => [|d ih] s s2 le h /=; first by rewrite addn0.
case: (joins B s) => [|[t why] [|[t' why'] [|//]]] //.
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
- by apply: lines; apply: V_neq => //; [exact/eqP | rewrite neq_ltn ts | rewrite neq_ltn ts'].
Qed.

(* the core of a body, by scales *)
Lemma coreP : (0 < core_size B)%N -> (core_size B <= body_size B)%N -> core_demands n (ok b) B (settled_by b) <> None ->
  (1 < core_size B)%N /\ same_cameras P Q (mkseq (fun i => V (node B i)) (core_size B)).
Proof.
move: ranks; rewrite /ranks_hold /core_demands; case: eqnP => [-> // | _] + _ CB; case: ifP => // C1; rewrite CB.
case e: (by_ _) => [a why|//]; case: ifP => // tok; case E: demands => [D|//] hD _; split=> //.
have inj i j : (i < core_size B)%N -> (j < core_size B)%N -> i != j -> V (node B i) != V (node B j).
  by move=> iC jC; apply: V_neq; exact: leq_trans CB.
have [t [t0 h]] := treeP niceP allowedP tok.
have [ok1 to1 f1 r1] := h 1%N C1.
have f0 : from (tree (settled_by b) 1) = 0%N by move: f1; case: (from _).
move: r1; rewrite /rel e to1 f0 => base.
have [|H uH e'] := demandsP niceP C1 inj allowedP t0 base E _ hD.
  by apply: hangingP => k /h [okk tok' _ r]; split=> //; rewrite tok'.
exists H => // _ /mapP [i + ->]; rewrite mem_iota => iC; exists (t i)^-1; first by rewrite invr_eq0.
by rewrite -e' // scalerA mulVf // scale1r.
Qed.
End Grow.

Lemma determinedP : determined n (ok b) (bodies b) (settled_by b) -> same_cameras P Q (nodes b).
Proof.
rewrite /determined; set B := bodies b; case: ifP => // s1; case: ifP => // /nodes_okP lt.
case: ifP => // /increasingP u; case E: core_demands => [D|//]; case: ifP => // _; case: eqnP => [c0|/eqP c0].
  case: ifP => //; rewrite /begins.
  case: (joins B 1) => [|[t why] [|//]] //; case: eqnP => // _ /allowedP base two.
  have start : same_cameras P Q (mkseq (fun i => V (node B i)) 2) by exact: same_turned.
  by have := joined_twiceP (s := 2) lt u isT _ start two; rewrite subnKC //; apply.
have C0 : (0 < core_size B)%N by rewrite lt0n.
have CB : (core_size B <= body_size B)%N by move: E; rewrite /core_demands -/B; case: eqnP => [e|_]; [rewrite e in c0 | do 2!case: ifP => //].
have [|C1 start] := coreP lt u C0 CB; first by rewrite -/B E.
by move/(joined_twiceP lt u C1 _ start); rewrite subnKC //; apply.
Qed.
End Body.

Lemma all_determinedP b : all_determined n m first second bodies sure settled_by b ->
  (forall c, (c < b)%N -> sure c -> ranks_hold P c) -> forall c, (c < b)%N -> sure c -> same_cameras P Q (nodes c).
Proof.
elim: b => //= b ih; case: ifP => [sb | nb].
  case: ifP => // det all_b ranks c; have before := ih all_b (fun c cb => ranks c (ltnW cb)).
  rewrite ltnS leq_eqVlt => /predU1P [-> _ | /before //]; exact: determinedP before (ranks _ (ltnSn _) sb) det.
by move=> all_b ranks c; rewrite ltnS leq_eqVlt => /predU1P [->|]; [rewrite nb | apply: (ih all_b (fun c cb => ranks c (ltnW cb)))].
Qed.

(* Corollary 4.2: where no body has a core, at all cameras with centres of which no three are on a line, not only at
   generic ones *)
Theorem corollary_4_2 b : solvable_ok n m first second bodies sure settled_by b ->
  (forall c, (c < b.+1)%N -> sure c -> ranks_hold P c) -> same_cameras P Q (enum 'I_n).
Proof.
rewrite /solvable_ok; case: ifP => // sb; case: eqnP => // size_n all_b ranks.
have h := all_determinedP all_b ranks (ltnSn b) sb.
apply: same_sub h => v _; move: all_b; rewrite /= sb; case: ifP => // + _.
rewrite /determined; case: ifP => // _; case: ifP => // /nodes_okP lt; case: ifP => // /increasingP u _.
have un : uniq (nodes b).
  rewrite map_inj_in_uniq ?iota_uniq // => i j; rewrite !mem_iota => /= ib jb; exact: (N_inj u lt).
have sub : {subset nodes b <= enum 'I_n} by move=> x _; rewrite mem_enum.
have := uniq_min_size un sub; rewrite size_mkseq size_n size_enum_ord leqnn => /(_ isT) [_ all_].
by rewrite all_ mem_enum.
Qed.
End Given.
End Sound.

Theorem verify_solvable n m first second by_pair bodies sure settled_by b :
  graph_ok n m first second by_pair -> solvable_ok n m first second bodies sure settled_by b -> solvable n (pairs m first second).
Proof.
move=> /graph_ok_sound good ok; split=> //.
have ranks : @generically n (3 * 4) (fun F P => forall c, (c < b.+1)%N -> sure c -> ranks_hold bodies sure settled_by good P c).
  by apply: all_determined_generic; move: ok; rewrite /solvable_ok; case: ifP => // _; case: eqnP.
apply: generically_impl (generically_and (generic_cameras n) ranks) => F P [nice ranksP] Q rankQ same.
exact: (corollary_4_2 nice rankQ same ok ranksP).
Qed.
