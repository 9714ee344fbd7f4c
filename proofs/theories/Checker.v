(* The program, and what its answer means. Arrays come in as functions, so that nothing is supposed about arrays. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From Viewcert Require Import Statement Skew Motions Generic NormalForm Counting Rigid Elimination.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Definition the_prime : nat := 2 ^ 16 - 15.

(* ------------------------------------------------------------------ the program *)

(* Keys are different if some order of them is increasing. *)
Fixpoint increasing (s : nat) (at_ : nat -> nat) (key : nat -> nat) (k : nat) : bool :=
  if k is k'.+1 then
    if at_ k' < s then
      if k' is k''.+1 then if key (at_ k'') < key (at_ k') then increasing s at_ key k' else false
      else true
    else false
  else true.

(* Why a pair of nodes may be used: it is a pair of the graph, by its number; or both nodes are in an earlier body,
   at these positions. *)
Inductive reason := Pair of nat | Inside of nat & nat & nat.

(* A body: its nodes one after the other, a core of the first ones with its rows (two positions, rows used, reason)
   and centres; each later node is joined to at most two nodes before it. *)
Record body := Body {
  body_size : nat; node : nat -> nat; by_node : nat -> nat;
  core_size : nat; core : seq (nat * nat * nat * reason); centre : nat -> nat -> nat;
  joins : nat -> seq (nat * reason) }.

(* A block: its nodes *)
Record block := Block { block_size : nat; block_node : nat -> nat }.

Section Program.
Variables (n m : nat) (first second : nat -> nat).

Fixpoint pairs_ok (k : nat) : bool :=
  if k is k'.+1 then
    if first k' < second k' then if second k' < n then pairs_ok k' else false else false
  else true.
Definition graph_ok (by_pair : nat -> nat) : bool :=
  if 1 < n then
    if pairs_ok m then increasing m by_pair (fun k => n * first k + second k) m else false
  else false.

Section Lower.
Variable bodies : nat -> body.

Definition pair_ok b x y (why : reason) : bool :=
  match why with
  | Pair k => if k < m then
      if eqn (first k) x then eqn (second k) y else if eqn (first k) y then eqn (second k) x else false
    else false
  | Inside c s t => if c < b then
      if s < body_size (bodies c) then
        if t < body_size (bodies c) then
          if eqn (node (bodies c) s) x then eqn (node (bodies c) t) y else false
        else false
      else false
    else false
  end.

Fixpoint core_ok b (B : body) (L : seq (nat * nat * nat * reason)) : bool :=
  if L is (i, j, _, why) :: L' then
    if i < core_size B then
      if j < core_size B then
        if pair_ok b (node B i) (node B j) why then core_ok b B L' else false
      else false
    else false
  else true.

Fixpoint nodes_ok (B : body) (k : nat) : bool :=
  if k is k'.+1 then if node B k' < n then nodes_ok B k' else false else true.

(* what the nodes behind the core add *)
Fixpoint joined b (B : body) (d acc : nat) : option nat :=
  if d is d'.+1 then
    let s := core_size B + d' in
    match joins B s with
    | [::] => joined b B d' acc
    | [:: (t, why)] =>
      if t < s then
        if pair_ok b (node B s) (node B t) why then joined b B d' (7 + acc) else None
      else None
    | [:: (t, why); (t', why')] =>
      if t < s then
        if t' < s then
          if eqn t t' then None
          else if pair_ok b (node B s) (node B t) why then
            if pair_ok b (node B s) (node B t') why' then joined b B d' (11 + acc) else None
          else None
        else None
      else None
    | _ => None
    end
  else Some acc.

Fixpoint core_rows (L : seq (nat * nat * nat * reason)) : seq (nat * nat * nat) :=
  if L is (e, _) :: L' then e :: core_rows L' else [::].

Definition body_rank b : option nat :=
  let B := bodies b in
  if core_size B <= body_size B then
    if nodes_ok B (body_size B) then
      if increasing (body_size B) (by_node B) (node B) (body_size B) then
        if core_ok b B (core B) then
          joined b B (body_size B - core_size B)
            (if core B is [::] then 0 else core_rank the_prime (centre B) (core_size B) (core_rows (core B)))
        else None
      else None
    else None
  else None.

Definition rigid b : bool :=
  if 1 < body_size (bodies b) then
    if body_rank b is Some r then 11 * body_size (bodies b) - 15 <= r else false
  else false.
Fixpoint all_rigid b : bool := if b is b'.+1 then if rigid b' then all_rigid b' else false else true.

(* bodies 0 .. b-1 are rigid, and body b has the rank r *)
Definition lower_ok b r : bool :=
  if all_rigid b then if body_rank b is Some s then r <= s else false else false.
End Lower.

Section Upper.
Variables (blocks : nat -> block) (place : nat -> option (nat * nat * nat)).

Fixpoint block_ok (B : block) (k : nat) : bool :=
  if k is k'.+1 then if block_node B k' < n then block_ok B k' else false else true.
Fixpoint blocks_sum (b acc : nat) : option nat :=
  if b is b'.+1 then
    let B := blocks b' in
    if 1 < block_size B then
      if block_ok B (block_size B) then blocks_sum b' (11 * block_size B - 15 + acc) else None
    else None
  else Some acc.
(* pairs in no block are blocks of their own *)
Fixpoint placed (b k acc : nat) : option nat :=
  if k is k'.+1 then
    match place k' with
    | None => placed b k' (7 + acc)
    | Some (c, s, t) =>
      if c < b then
        if s < block_size (blocks c) then
          if t < block_size (blocks c) then
            if eqn (block_node (blocks c) s) (first k') then
              if eqn (block_node (blocks c) t) (second k') then placed b k' acc else None
            else None
          else None
        else None
      else None
    end
  else Some acc.
Definition upper_ok b r : bool :=
  if blocks_sum b 0 is Some acc then if placed b m acc is Some s then s <= r else false else false.
End Upper.
End Program.

(* The whole check: a lower bound of 0 and an upper one of 11 n - 15 need no proof. *)
Definition lower_part n m first second bodies b r : bool :=
  if eqn r 0 then true else lower_ok n m first second bodies b r.
Definition upper_part n m first second blocks c place r : bool :=
  if 11 * n - 15 <= r then true else upper_ok n m first second blocks place c r.
Definition verify n m first second by_pair bodies b lower blocks c place upper : bool :=
  if graph_ok n m first second by_pair then
    if lower_part n m first second bodies b lower then upper_part n m first second blocks c place upper
    else false
  else false.

(* ------------------------------------------------------------------ its soundness *)

Lemma the_prime_is_prime : prime the_prime.
Proof. by vm_compute. Qed.

Lemma increasingP s at_ key : increasing s at_ key s -> uniq (mkseq key s).
Proof.
have sub k : increasing s at_ key k -> forall i, i < k -> at_ i < s.
  elim: k => [|k ih] //= h i; case: ifP h => // ks h; rewrite ltnS leq_eqVlt => /predU1P [-> // | ik].
  by case: k ih ks h ik => // k ih _; case: ifP => // _ /ih; apply.
have step k i : increasing s at_ key k -> i.+1 < k -> key (at_ i) < key (at_ i.+1).
  elim: k => [|k ih] //= h; case: ifP h => // _; rewrite ltnS leq_eqVlt => h /predU1P [ik | ik].
    by move: h; rewrite -ik; case: ifP.
  by apply: ih => //; case: k h ik => // k; case: ifP.
move=> h; have lt i j : i < j -> j < s -> key (at_ i) < key (at_ j).
  elim: j => // j ih; rewrite ltnS leq_eqVlt => /predU1P [-> | /ih lt] js; first exact: step h js.
  exact: ltn_trans (lt (ltnW js)) (step _ _ h js).
have u : uniq (mkseq (key \o at_) s).
  apply/mkseq_uniqP => i j; rewrite !inE => si sj /= e; apply/eqP; move: e.
  by case: (ltngtP i j) => // ij; [have := lt _ _ ij sj | have := lt _ _ ij si] => /[swap] ->; rewrite ltnn.
apply: (leq_size_uniq u); last by rewrite !size_mkseq.
by move=> _ /mapP [i + ->]; rewrite mem_iota => /(sub s h i) ai; apply: map_f; rewrite mem_iota.
Qed.

Section Graph.
Variables (n m : nat) (first second : nat -> nat).
Local Notation G := (pairs m first second).

Lemma pairs_okP k : pairs_ok n first second k -> forall i, i < k -> first i < second i < n.
Proof.
elim: k => [|k ih] //= h i; case: ifP h => // fs; case: ifP => // sn /ih {}ih.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /ih //]; rewrite fs.
Qed.

Theorem graph_ok_sound by_pair : graph_ok n m first second by_pair -> well_formed n G.
Proof.
rewrite /graph_ok /well_formed; case: ifP => // n1; case: ifP => // /pairs_okP lt /increasingP u.
 apply/and3P; split=> //.
- by apply/allP=> _ /mapP [k + ->]; rewrite mem_iota => /lt.
- by apply: (@map_uniq _ _ (fun e => n * e.1 + e.2)); rewrite -map_comp.
Qed.
End Graph.

Section Sound.
Variables (n m : nat) (first second : nat -> nat) (bodies : nat -> body).
Local Notation G := (pairs m first second).
Hypothesis good : well_formed n G.
Lemma n_positive : 0 < n. Proof. by case/and3P: good => n1 _ _; apply: ltnW. Qed.
Definition V (x : nat) : 'I_n := insubd (Ordinal n_positive) x.
Lemma valV x : x < n -> val (V x) = x. Proof. by move=> xn; rewrite /V insubdK. Qed.

Definition nodes b : seq 'I_n := mkseq (fun i => V (node (bodies b) i)) (body_size (bodies b)).
Definition all_pairs (b : seq 'I_n) : seq ('I_n * 'I_n) := [seq (x, y) | x <- b, y <- b].
(* what may be used for body b *)
Fixpoint usable b : seq ('I_n * 'I_n) := if b is b'.+1 then all_pairs (nodes b') ++ usable b' else edges n G.

Lemma usable_edge b e : e \in edges n G -> e \in usable b.
Proof. by move=> eG; elim: b => //= b ih; rewrite mem_cat ih orbT. Qed.
Lemma usable_body b c e : c < b -> inside (nodes c) e -> e \in usable b.
Proof.
case: e => x y + /andP [xb yb]; elim: b => //= b ih; rewrite ltnS leq_eqVlt mem_cat.
by case/predU1P=> [<- | /ih ->]; rewrite ?orbT // allpairs_f.
Qed.

Lemma either_swap E (e : 'I_n * 'I_n) : either E (swap e) -> either E e.
Proof. by case: e => x y; rewrite /either /swap /= orbC. Qed.

Lemma edge_of k : k < m -> (V (first k), V (second k)) \in edges n G.
Proof.
move=> km; have kG : (first k, second k) \in G by apply: map_f; rewrite mem_iota.
have /and3P [_ /allP /(_ _ kG) /andP [/= fs sn] _] := good.
by apply: edges_mem; rewrite !valV // (ltn_trans fs).
Qed.

Lemma pair_okP b x y why : pair_ok m first second bodies b x y why -> either (usable b) (V x, V y).
Proof.
case: why => [k | c s t] /=.
  case: ifP => // /edge_of /(usable_edge b) kE; case: eqnP => [<- /eqnP <- | _]; first by rewrite /either kE.
  by case: eqnP => // <- /eqnP <-; rewrite /either /swap /= kE orbT.
case: ifP => // cb; case: ifP => // sc; case: ifP => // tc; case: eqnP => // <- /eqnP <-.
apply/orP; left; apply: usable_body cb _.
by rewrite /inside /nodes; apply/andP; split; apply: map_f; rewrite mem_iota.
Qed.

Section Body.
Variable b : nat.
Let B := bodies b.
Let N i := V (node B i).
Hypothesis uniqB : uniq (mkseq (node B) (body_size B)).
Hypothesis ltB : forall i, i < body_size B -> node B i < n.

Lemma N_inj i j : i < body_size B -> j < body_size B -> N i = N j -> i = j.
Proof.
move=> ib jb /(congr1 val); rewrite !valV ?ltB // => e.
by apply: (mkseq_uniqP _ _ uniqB).
Qed.

Lemma inside_S k e : inside (mkseq N k) e -> inside (mkseq N k.+1) e.
Proof. by rewrite /inside mkseqS !mem_rcons !inE => /andP [-> ->]; rewrite !orbT. Qed.
Lemma N_neq i k : i < k -> k < body_size B -> N k != N i.
Proof. by move=> ik kB; apply/eqP => /(N_inj kB (ltn_trans ik kB)) ki; rewrite ki ltnn in ik. Qed.
Lemma inside_out k e : k < body_size B -> inside (mkseq N k) e -> (e.1 != N k) && (e.2 != N k).
Proof.
by move=> kB /andP [/mapP [i + ->] /mapP [j + ->]]; rewrite !mem_iota => /= ik jk; rewrite ![_ == N k]eq_sym !N_neq.
Qed.
Lemma N_in k i : i < k -> N i \in mkseq N k.
Proof. by move=> ik; apply: map_f; rewrite mem_iota. Qed.

Definition shown k r := exists T : seq ('I_n * 'I_n),
  [/\ all (inside (mkseq N k)) T, all (either (usable b)) T & attained T r].

Lemma shown_S k r : shown k r -> shown k.+1 r.
Proof. by case=> T [i e a]; exists T; split=> //; apply: sub_all i => e'; apply: inside_S. Qed.

Lemma joinedP l d acc r : shown (core_size B) l -> core_size B + d <= body_size B ->
  joined m first second bodies b B d acc = Some r ->
  exists2 v, r = v + acc & shown (core_size B + d) (l + v).
Proof.
move=> base; elim: d acc => [|d ih] acc le /=; first by move=> [<-]; exists 0; rewrite ?addn0.
rewrite addnS in le *; set s := core_size B + d in le *.
case: (joins B s) => [|[t why] [|[t' why'] [|? ?]]] //.
- by case/(ih _ (ltnW le)) => v -> h; exists v => //; apply: shown_S.
- case: ifP => // ts; case: ifP => // ok /(ih _ (ltnW le)) [v -> [T [iT eT aT]]]; exists (v + 7); first by lia.
  exists ((N s, N t) :: T); split.
  + rewrite /= {1}/inside /= !N_in // ?(ltnW ts) ?(leqW ts) //=; apply: sub_all iT => e'; exact: inside_S.
  + by apply/andP; split; [exact: pair_okP ok | exact: eT].
  + rewrite addnA; apply: grow_one aT.
      exact: N_neq.
    by apply: sub_all iT => e'; apply: inside_out.
- case: ifP => // ts; case: ifP => // ts'; case: eqnP => // tt; case: ifP => // ok; case: ifP => // ok'.
  case/(ih _ (ltnW le)) => v -> [T [iT eT aT]]; exists (v + 11); first by lia.
  exists ((N s, N t) :: (N s, N t') :: T); split.
  + rewrite /= {1 2}/inside /= !N_in ?(leqW ts) ?(leqW ts') //=; apply: sub_all iT => e'; exact: inside_S.
  + by apply/and3P; split; [exact: pair_okP ok | exact: pair_okP ok' | exact: eT].
  + rewrite addnA; apply: grow_two aT.
    * exact: N_neq.
    * exact: N_neq.
    * by apply/eqP => /(N_inj (ltn_trans ts le) (ltn_trans ts' le)).
    by apply: sub_all iT => e'; apply: inside_out.
Qed.

Lemma core_okP L : core_ok m first second bodies b B L ->
  all (fun e => (e.1.1 < core_size B) && (e.1.2 < core_size B)) (core_rows L) /\
  (forall e, e \in core_rows L -> either (usable b) (N e.1.1, N e.1.2)).
Proof.
elim: L => [|[[[i j] k] why] L ih] //=; case: ifP => // ic; case: ifP => // jc; case: ifP => // /pair_okP ok.
case/ih => lt el; rewrite /= lt; split=> // e; rewrite inE => /predU1P [-> | /el] //.
Qed.

Lemma core_shown : core_size B <= body_size B -> core_ok m first second bodies b B (core B) ->
  shown (core_size B) (if core B is [::] then 0 else core_rank the_prime (centre B) (core_size B) (core_rows (core B))).
Proof.
move=> le /core_okP [lt el]; case e: (core B) => [|c L]; first by exists [::]; split=> //; exists (0%R).
rewrite -e; have a := core_rank_sound the_prime_is_prime (centre B) lt.
pose s (i : 'I_(core_size B)) := N i.
have s_inj : injective s.
  by move=> i j /N_inj ij; apply/val_inj/ij; apply: leq_trans le.
exists (moved s (edges (core_size B) (pairs_of (core_rows (core B))))); split; last exact: attained_moved s_inj a.
  by apply/allP=> _ /mapP [[i j] _ ->]; rewrite /inside /= !N_in.
apply/allP=> _ /mapP [[i j] + ->] /=; rewrite mem_pmap => /mapP [[x y] /mapP [k kL xy]] /=.
case: insubP => // i' _ ex; case: insubP => // j' _ ey [-> ->].
by have := el _ kL; rewrite -xy /= -ex -ey.
Qed.
End Body.

Lemma nodes_okP B k : nodes_ok n B k -> forall i, i < k -> node B i < n.
Proof.
elim: k => [|k ih] //=; case: ifP => // kn /ih {}ih i.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /ih].
Qed.

Lemma body_rankP b r : body_rank n m first second bodies b = Some r -> shown b (body_size (bodies b)) r.
Proof.
rewrite /body_rank; case: ifP => // le; case: ifP => // /nodes_okP lt; case: ifP => // /increasingP u.
case: ifP => // ok; have base := core_shown u lt le ok.
by move/(joinedP u lt base) => []; rewrite subnKC // => v -> h; rewrite addnC.
Qed.

Lemma all_rigidP b r : all_rigid n m first second bodies b -> attained (usable b) r -> attained (edges n G) r.
Proof.
elim: b => //= b ih; case: ifP => // rig /ih {}ih a; apply: ih; move: rig; rewrite /rigid.
case: ifP => // s1; case e: body_rank => [s|//] les; have [T [iT eT [P aT]]] := body_rankP e.
apply: (theorem_4_1 (T := T) (b := nodes b)) a => //; first by rewrite size_mkseq.
- by apply/allP=> _ /allpairsP [[x y] [xb yb ->]]; rewrite /inside xb.
- by exists P; rewrite size_mkseq; apply: leq_trans les aT.
Qed.

Theorem lower_ok_sound b r : lower_ok n m first second bodies b r -> rank_at_least n G r.
Proof.
rewrite /lower_ok; case: ifP => // rig; case e: body_rank => [s|//] rs.
have [T [_ eT aT]] := body_rankP e; have [P h] := all_rigidP rig (attained_either eT aT).
by exists P; apply: leq_trans rs h.
Qed.

Lemma edges_V e : e \in edges n G -> exists2 k, k < m & e = (V (first k), V (second k)).
Proof.
rewrite mem_pmap => /mapP [[x y] /mapP [k + [-> ->]] /=]; rewrite mem_iota => /= km.
case: insubP => // i lti ei; case: insubP => // j ltj ej [->]; exists k => //.
by congr (_, _); apply: val_inj; rewrite valV.
Qed.

Section Upper.
Variables (blocks : nat -> block) (place : nat -> option (nat * nat * nat)).
Definition of_block c : seq 'I_n := mkseq (fun i => V (block_node (blocks c) i)) (block_size (blocks c)).

Lemma blocks_sumP b acc r : blocks_sum n blocks b acc = Some r ->
  all (fun B => 1 < size B) [seq of_block c | c <- iota 0 b]
  /\ r = (\sum_(B <- [seq of_block c | c <- iota 0 b]) (11 * size B - 15)) + acc.
Proof.
elim: b acc => [|b ih] acc; first by move=> [<-]; rewrite big_nil.
rewrite [blocks_sum _ _ _ _]/=; case: ifP => // s1; case: ifP => // _ /ih [a ->].
rewrite (_ : iota 0 b.+1 = iota 0 b ++ [:: b]); last by rewrite -[b.+1]addn1 iotaD.
by rewrite map_cat all_cat a big_cat big_seq1 /= size_mkseq s1 addnA.
Qed.

Lemma placedP b k acc r : placed first second blocks place b k acc = Some r -> exists L : seq (seq 'I_n),
  [/\ r = 7 * size L + acc, all (fun B => size B == 2) L
    & forall i, i < k -> has (fun B => inside B (V (first i), V (second i))) ([seq of_block c | c <- iota 0 b] ++ L)].
Proof.
elim: k acc => [|k ih] acc /=; first by move=> [<-]; exists [::].
case: (place k) => [[[c s] t]|].
  case: ifP => // cb; case: ifP => // sc; case: ifP => // tc; case: eqnP => // e1; case: eqnP => // e2.
  case/ih=> L [-> two cov]; exists L; split=> // i; rewrite ltnS leq_eqVlt => /predU1P [-> | /cov //].
  rewrite has_cat; apply/orP; left; apply/hasP; exists (of_block c).
    by apply: map_f; rewrite mem_iota.
  by rewrite /inside -e1 -e2; apply/andP; split; apply: map_f; rewrite mem_iota.
case/ih=> L [-> two cov]; exists ([:: V (first k); V (second k)] :: L); split=> //=; first by lia.
move=> i; rewrite ltnS leq_eqVlt has_cat /= => /predU1P [-> | /cov].
  by rewrite /inside /= !inE !eqxx !orbT.
by rewrite has_cat => /orP [->|->]; rewrite ?orbT.
Qed.

Theorem upper_ok_sound c r : upper_ok n m first second blocks place c r -> rank_at_most n G r.
Proof.
rewrite /upper_ok; case e: blocks_sum => [acc|//]; have [s1 es] := blocks_sumP e.
case e': placed => [s|//] sr F P; have [L [el two cov]] := placedP e'.
apply: leq_trans sr; set A := [seq of_block c | c <- iota 0 c] in s1 es cov.
apply: leq_trans (theorem_5_1 (B := A ++ L) P _ _) _.
- by rewrite all_cat s1; apply/allP=> B /(allP two) /eqP ->.
- by apply/allP=> e2 /edges_V [k km ->]; apply: cov.
rewrite big_cat /= el es addn0 addnC leq_add2r.
elim: L two {el cov} => [|B L ih] /=; first by rewrite big_nil.
by case/andP=> /eqP sB /ih; rewrite big_cons sB; lia.
Qed.
End Upper.
End Sound.

Theorem verify_sound n m first second by_pair bodies b lower blocks c place upper :
  verify n m first second by_pair bodies b lower blocks c place upper ->
  let G := pairs m first second in
  [/\ well_formed n G, rank_at_least n G lower & rank_at_most n G upper].
Proof.
rewrite /verify; case: ifP => // /graph_ok_sound good; case: ifP => // lo up; split=> //.
  move: lo; rewrite /lower_part; case: eqnP => [-> _|_]; first by exists 0%R.
  exact: (lower_ok_sound good).
move: up; rewrite /upper_part; case: ifP => [le _ F P | _]; last exact: (upper_ok_sound good).
by apply: leq_trans le; apply: lemma_1_1; case/and3P: good.
Qed.

(* What the program prints, in the words of Statement.v *)
Section Corollaries.
Variables (n : nat) (G : seq (nat * nat)).

Corollary exact_rank r : [/\ well_formed n G, rank_at_least n G r & rank_at_most n G r] -> generic_rank n G r.
Proof. by []. Qed.

Corollary has_full_rank u :
  [/\ well_formed n G, rank_at_least n G (11 * n - 15) & rank_at_most n G u] -> full_rank n G.
Proof. by case=> good low _; split=> // F P; apply: lemma_1_1; case/and3P: good. Qed.

Corollary lacks_full_rank l u : u < 11 * n - 15 ->
  [/\ well_formed n G, rank_at_least n G l & rank_at_most n G u] -> ~ full_rank n G.
Proof.
by move=> lt [_ _ up] [_ [P low] _]; have := leq_trans low (up _ P); rewrite leqNgt lt.
Qed.
End Corollaries.
