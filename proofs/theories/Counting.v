(* Section 5: upper bounds. All of them hold at all cameras. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From Viewcert Require Import Statement Skew Motions Generic.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Lemma edgesE n G (e : 'I_n * 'I_n) : (e \in edges n G) = ((val e.1, val e.2) \in G).
Proof.
rewrite mem_pmap; apply/mapP/idP => [[[x y] xyG /=] | eG]; last by exists (val e.1, val e.2) => //=; rewrite !valK; case: e eG.
by case: insubP => // i _ ix; case: insubP => // j _ jy [->] /=; rewrite ix jy.
Qed.

Section Modular.
Variables (F : numFieldType) (n : nat).
Implicit Types (E : seq ('I_n * 'I_n)) (P : cameras F n).

(* Theorem 5.9, for sets that share E0 at least *)
Theorem theorem_5_9 E1 E2 E0 P : {subset E0 <= E1} -> {subset E0 <= E2} ->
  (\rank (J (E1 ++ E2) P) + \rank (J E0 P) <= \rank (J E1 P) + \rank (J E2 P))%N.
Proof.
move=> s1 s2; set K1 := kermx (J E1 P); set K2 := kermx (J E2 P).
have h : (K1 :&: K2 <= kermx (J (E1 ++ E2) P))%MS.
  by apply/rV_subP=> u; rewrite sub_capmx !J_kerP all_cat.
have k : (K1 + K2 <= kermx (J E0 P))%MS by rewrite addsmx_sub !ker_mono.
have := mxrankS h; have := mxrankS k; have := mxrank_sum_cap K1 K2.
rewrite !mxrank_ker; have := rank_leq_row (J E1 P); have := rank_leq_row (J E2 P).
by have := rank_leq_row (J E0 P); have := rank_leq_row (J (E1 ++ E2) P); lia.
Qed.

Lemma J_cat E1 E2 P : (\rank (J (E1 ++ E2) P) <= \rank (J E1 P) + \rank (J E2 P))%N.
Proof. by have := @theorem_5_9 E1 E2 [::] P; rewrite J_nil addn0; apply. Qed.

Lemma J_flatten (Es : seq (seq ('I_n * 'I_n))) P :
  (\rank (J (flatten Es) P) <= \sum_(E <- Es) \rank (J E P))%N.
Proof.
elim: Es => [|E Es ih]; first by rewrite J_nil.
by rewrite big_cons /=; apply: leq_trans (J_cat _ _ _) _; rewrite leq_add2l.
Qed.
End Modular.

Section Bounds.
Variables (F : numFieldType) (n : nat).
Implicit Types (E : seq ('I_n * 'I_n)) (P : cameras F n) (b : seq 'I_n).

Definition inside b (e : 'I_n * 'I_n) := (e.1 \in b) && (e.2 \in b).

(* Lemma 1.1 for the pairs among some nodes *)
Lemma rank_inside b E P : (1 < size b)%N -> all (inside b) E -> (\rank (J E P) <= 11 * size b - 15)%N.
Proof.
move=> sb /allP ins; pose s := tnth (in_tuple b).
pose A := moved s (enum {: 'I_(size b) * 'I_(size b)}).
apply: leq_trans (_ : _ <= \rank (J A P))%N _.
  apply: J_mono => -[x y] /ins.
  case/andP=> /= /(tnthP (in_tuple b)) [i ->] /(tnthP (in_tuple b)) [j ->].
  by apply/mapP; exists (i, j); rewrite ?mem_enum.
exact: leq_trans (J_local _ _ _) (lemma_1_1 _ _ sb).
Qed.

(* Theorem 5.1. Blocks are sets of nodes here, and may share pairs: a partition of the pairs is a special case. *)
Theorem theorem_5_1 E (B : seq (seq 'I_n)) P :
  all (fun b => 1 < size b)%N B -> all (fun e => has (inside^~ e) B) E ->
  (\rank (J E P) <= \sum_(b <- B) (11 * size b - 15))%N.
Proof.
move=> /allP sB /allP cov.
apply: leq_trans (_ : \rank (J (flatten [seq [seq e <- E | inside b e] | b <- B]) P) <= _)%N.
  apply: J_mono => e eE; have /hasP [b bB be] := cov e eE.
  by apply/flattenP; exists [seq e <- E | inside b e];
    [apply/mapP; exists b | rewrite mem_filter be].
apply: leq_trans (J_flatten _ _) _; rewrite big_map !big_seq.
by apply: leq_sum => b /sB sb; apply: rank_inside (filter_all _ _).
Qed.

(* Corollary 5.11. Pairs of E1 and E2 need not be pairs of the graph that is bounded: 5.13 is [J_mono]. *)
Theorem corollary_5_11 E1 E2 E0 u1 u2 l (P0 : cameras F n) :
  {subset E0 <= E1} -> {subset E0 <= E2} -> (l <= \rank (J E0 P0))%N ->
  (forall P, \rank (J E1 P) <= u1)%N -> (forall P, \rank (J E2 P) <= u2)%N ->
  forall P, (\rank (J (E1 ++ E2) P) + l <= u1 + u2)%N.
Proof.
move=> s1 s2 hl h1 h2 P; have [Q [r1 r2]] := both_J E0 (E1 ++ E2) P0 P.
by have := theorem_5_9 Q s1 s2; have := h1 Q; have := h2 Q; lia.
Qed.

(* Section 6, without the lifting of 6.4: if E has at most the rank r everywhere, and the pair (x, y) raises it at some
   cameras, then no rigid part E' of E holds both x and y. *)
Theorem separation E E' b x y r (P1 P2 : cameras F n) :
  uniq b -> (1 < size b)%N -> x \in b -> y \in b -> all (inside b) E' -> {subset E' <= E} ->
  (forall P, \rank (J E P) <= r)%N -> (r < \rank (J ((x, y) :: E) P1))%N ->
  \rank (J E' P2) <> (11 * size b - 15)%N.
Proof.
move=> _ sb xb yb inb s rE r1 eP2.
have u1 P : (\rank (J ((x, y) :: E') P) <= 11 * size b - 15)%N.
  by apply: rank_inside; rewrite //= inb andbT /inside xb.
have s1 : {subset E' <= (x, y) :: E'} by move=> e eE; rewrite inE eE orbT.
have h := corollary_5_11 s1 s (eq_leq (esym eP2)) u1 rE P1.
rewrite addnC leq_add2l in h.
have : (\rank (J ((x, y) :: E) P1) <= \rank (J (((x, y) :: E') ++ E) P1))%N.
  by apply: J_mono => e; rewrite mem_cat !inE => /orP [-> //|->]; rewrite orbT.
by move/(leq_trans r1)/leq_trans/(_ h); rewrite ltnn.
Qed.
End Bounds.
