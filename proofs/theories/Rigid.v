(* Section 4: lower bounds without arithmetic.

   The merge rules of Theorem 4.1, pieces (4.3) and what cores need of 4.4 come from two facts. A node that is joined
   to two (one) of the nodes before it adds 11 (7) to the rank. And where some pairs among the nodes b reach the rank
   11 |b| - 15, every other pair of nodes of b may be used as if it were there. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Generic NormalForm Counting.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(* A pair counts whichever way round it is. *)
Definition swap (T : Type) (e : T * T) := (e.2, e.1).
Definition either (T : eqType) (E : seq (T * T)) e := (e \in E) || (swap e \in E).

Section Either.
Variables (F : numFieldType) (n : nat).
Implicit Types (E : seq ('I_n * 'I_n)) (P : cameras F n).

Lemma J_either E1 E2 P : all (either E2) E1 -> (\rank (J E1 P) <= \rank (J E2 P))%N.
Proof.
move=> /allP sub; apply: rank_by_ker; apply/rV_subP=> u; rewrite !J_kerP => /allP h.
apply/allP=> -[x y] /sub /orP [/h // | /h]; by rewrite /swap /= equation_swap.
Qed.
End Either.

Lemma attained_either n (E1 E2 : seq ('I_n * 'I_n)) r : all (either E2) E1 -> attained E1 r -> attained E2 r.
Proof. by move=> s [P h]; exists P; apply: leq_trans h (J_either P s). Qed.

(* ------------------------------------------------------------------ a node is added *)
Section Extend.
Variables (F : numFieldType) (n : nat) (v : 'I_n).
Implicit Types (E W : seq ('I_n * 'I_n)) (P : cameras F n).

(* motions of node v alone *)
Definition alone (R : comRingType) : 'M[R]_(1 * (3 * 4), n * (3 * 4)) := lin_mx (mulmx (delta_mx v 0 : 'cV_n)).

Lemma map_alone (R S : comRingType) (f : {rmorphism R -> S}) : map_mx f (alone R) = alone S.
Proof. by apply: map_lin_mx => A; rewrite map_mxM map_delta_mx. Qed.

Lemma cam_alone (x : 'rV[F]_(3 * 4)) w :
  cam (delta_mx v 0 *m x : cameras F n) w = if w == v then vec_mx x else 0.
Proof.
rewrite /cam row_mul; have -> : row w (delta_mx v (0 : 'I_1)) = ((w == v)%:R : F)%:M.
  by apply/rowP=> j; rewrite !mxE !ord1 /= !eqxx andbT mulr1n.
by rewrite mul_scalar_mx; case: eqP => _; rewrite ?scale1r // scale0r linear0.
Qed.

Lemma extend E W P : all (fun e => (e.1 != v) && (e.2 != v)) E ->
  (\rank (J E P) + \rank (alone F *m J W P) <= \rank (J (W ++ E) P))%N.
Proof.
move=> /allP out; set K := kermx (J E P).
have aK : (alone F <= K)%MS.
  apply/rV_subP=> _ /submxP [u ->]; rewrite J_kerP; apply/allP=> e /out /andP [n1 n2].
  by rewrite mul_rV_lin mxvecK /equation !cam_alone (negbTE n1) (negbTE n2) !mulmx0 addr0 trmx0 addr0.
have : (\rank (alone F *m J W P) <= \rank (K *m J W P))%N := mxrankS (submxMr (J W P) aK).
have : (\rank (K *m J W P) + \rank (K :&: kermx (J W P)) = \rank K)%N := mxrank_mul_ker K (J W P).
have : (\rank (kermx (J (W ++ E) P)) <= \rank (K :&: kermx (J W P)))%N.
  by apply/mxrankS/rV_subP=> u; rewrite sub_capmx !J_kerP all_cat andbC.
rewrite /K !mxrank_ker; have := rank_leq_row (J E P); have := rank_leq_row (J (W ++ E) P); lia.
Qed.
End Extend.

Lemma rank_by_coordinates (F : fieldType) m q f (A : 'M[F]_(m, q)) (C : 'M_(m, f)) :
  (forall u : 'rV_m, u *m A = 0 -> u *m C = 0 -> u = 0) -> (m <= \rank A + f)%N.
Proof.
move=> h; have := mxrank_mul_ker (kermx A) C; have -> : \rank (kermx A :&: kermx C) = 0%N.
  apply/eqP; rewrite mxrank_eq0 -submx0; apply/rV_subP=> u; rewrite sub_capmx submx0.
  by case/andP=> /sub_kermxP uA /sub_kermxP uC; rewrite (h u).
by rewrite mxrank_ker; have := rank_leq_col (kermx A *m C); have := rank_leq_row A; lia.
Qed.

(* at c_v = 0, c_a = e_1, c_b = e_2; b is a number, so that there need not be a third node *)
Section Local.
Variables (F : numFieldType) (n : nat) (v a : 'I_n) (b : nat).
Hypotheses (va : v != a) (vb : val v != b) (ab : val a != b).

Definition corner (w k : nat) : F := ((w == a) && (k == 0%N) || (w == b) && (k == 1%N))%:R.
Definition local_cameras := normal n corner.

Notation o i := (@Ordinal 4 i isT).
Notation r i := (@Ordinal 3 i isT).

Lemma local_equation w (D : 'M[F]_(3, 4)) (i j : 'I_4) : v != w ->
  let g := M_entry 0 +%R *%R -%R (corner v) (corner w) in
  equation local_cameras (v, w) (delta_mx v 0 *m (mxvec D : 'rV_(3 * 4))) i j =
    g i 0%N * D (r 0) j + g i 1%N * D (r 1) j + g i 2%N * D (r 2) j
    + (g j 0%N * D (r 0) i + g j 1%N * D (r 1) i + g j 2%N * D (r 2) i).
Proof.
move=> vw g; rewrite equation_normal /value /combination !big_cons big_nil; set u := delta_mx _ _ *m _.
have cv (h : 'I_3) (k : 'I_4) : coord u (key v h k) = D h k by rewrite coord_key cam_alone eqxx mxvecK.
have cw (h : 'I_3) (k : 'I_4) : coord u (key w h k) = 0 by rewrite coord_key cam_alone eq_sym (negbTE vw) mxE.
rewrite !(cv (r 0)) !(cv (r 1)) !(cv (r 2)) !(cw (r 0)) !(cw (r 1)) !(cw (r 2)) /= -/g.
by rewrite !mulr0 !addr0 !addrA.
Qed.

(* some entries of dP_v *)
Definition pick f (at_ : 'I_f -> 'I_3 * 'I_4) (u : 'rV[F]_(1 * (3 * 4))) : 'rV[F]_f :=
  \row_k (vec_mx (vec_mx u) : 'M_(3, 4)) (at_ k).1 (at_ k).2.
Lemma pick_is_linear f at_ : linear (@pick f at_).
Proof. by move=> x u w; apply/rowP=> k; rewrite [LHS]mxE !linearP /= !mxE. Qed.

Lemma rank_local W f (at_ : 'I_f -> 'I_3 * 'I_4) :
  (forall D : 'M_(3, 4), (forall k, D (at_ k).1 (at_ k).2 = 0) ->
    (forall e, e \in W -> equation local_cameras e (delta_mx v 0 *m (mxvec D : 'rV_(3 * 4))) = 0) -> D = 0) ->
  (12 <= \rank (alone v F *m J W local_cameras) + f)%N.
Proof.
move=> h; apply: (rank_by_coordinates (C := lin1_mx (Linear (@pick_is_linear f at_)))) => u.
rewrite mulmxA mul_rV_lin => /eqP; rewrite J_ker mxvecK => /allP uW.
rewrite mul_rV_lin1 /= => /rowP u0.
suff D0 : vec_mx (vec_mx u) = 0 :> 'M_(3, 4) by rewrite -[u]vec_mxK -[vec_mx u]vec_mxK D0 !linear0.
apply: h => [k | e /uW]; first by have := u0 k; rewrite !mxE.
by rewrite vec_mxK => /eqP.
Qed.

Lemma scaled_zero (k x y : F) : k != 0 -> k * x = y -> y = 0 -> x = 0.
Proof. by move=> k0 <- /eqP; rewrite mulf_eq0 (negbTE k0) /= => /eqP. Qed.

Lemma corner_v k : corner v k = 0. Proof. by rewrite /corner val_eqE (negbTE va) (negbTE vb). Qed.
Lemma corner_a k : corner a k = (k == 0%N)%:R. Proof. by rewrite /corner eqxx (negbTE ab) /= orbF. Qed.
Lemma corner_b k : corner b k = (k == 1%N)%:R. Proof. by rewrite /corner eqxx eq_sym (negbTE ab). Qed.

(* the equation of (v, w), and what an entry of it says of dP_v *)
Ltac entry_ e i j k := apply: (@scaled_zero k _ _ _ _ (e (o i) (o j)));
  [by rewrite ?oppr_eq0 ?oner_eq0 ?pnatr_eq0
  | by rewrite /M_entry /F_entry /diff /= ?corner_v ?corner_a ?corner_b /=; ring].
Lemma local_entries w (D : 'M[F]_(3, 4)) : v != w ->
  equation local_cameras (v, w) (delta_mx v 0 *m (mxvec D : 'rV_(3 * 4))) = 0 -> forall i j : 'I_4,
  let g := M_entry 0 +%R *%R -%R (corner v) (corner w) in
  g i 0%N * D (r 0) j + g i 1%N * D (r 1) j + g i 2%N * D (r 2) j
  + (g j 0%N * D (r 0) i + g j 1%N * D (r 1) i + g j 2%N * D (r 2) i) = 0.
Proof. by move=> vw /matrixP eq i j g; rewrite -local_equation // eq mxE. Qed.

Lemma local_a (D : 'M[F]_(3, 4)) :
  equation local_cameras (v, a) (delta_mx v 0 *m (mxvec D : 'rV_(3 * 4))) = 0 ->
  [/\ D (r 1) (o 0) = 0, D (r 2) (o 0) = 0, D (r 2) (o 1) = 0 & D (r 1) (o 2) = 0] /\
  [/\ D (r 2) (o 2) = D (r 1) (o 1), D (r 1) (o 3) = 0 & D (r 2) (o 3) = 0].
Proof.
move=> /(local_entries va) e; split; split.
- entry_ e 0%N 2%N (1 : F).
- entry_ e 0%N 1%N (-1 : F).
- entry_ e 1%N 1%N (-2%:R : F).
- entry_ e 2%N 2%N (2%:R : F).
- by apply/eqP; rewrite -subr_eq0; apply/eqP; entry_ e 1%N 2%N (-1 : F).
- entry_ e 2%N 3%N (1 : F).
- entry_ e 1%N 3%N (-1 : F).
Qed.

Lemma local_b (b' : 'I_n) (D : 'M[F]_(3, 4)) : val b' = b ->
  equation local_cameras (v, b') (delta_mx v 0 *m (mxvec D : 'rV_(3 * 4))) = 0 ->
  [/\ D (r 0) (o 1) = 0, D (r 0) (o 2) = 0, D (r 0) (o 3) = 0 & D (r 2) (o 2) = D (r 0) (o 0)].
Proof.
move=> bb; have vb' : v != b' by rewrite -val_eqE bb.
move=> /(local_entries vb'); rewrite bb => e; split.
- entry_ e 2%N 1%N (-1 : F).
- entry_ e 2%N 2%N (-2%:R : F).
- entry_ e 2%N 3%N (-1 : F).
- by apply/eqP; rewrite -subr_eq0; apply/eqP; entry_ e 0%N 2%N (1 : F).
Qed.

Lemma entries_zero (D : 'M[F]_(3, 4)) :
  [/\ D (r 0) (o 0) = 0, D (r 0) (o 1) = 0, D (r 0) (o 2) = 0 & D (r 0) (o 3) = 0] ->
  [/\ D (r 1) (o 0) = 0, D (r 1) (o 1) = 0, D (r 1) (o 2) = 0 & D (r 1) (o 3) = 0] ->
  [/\ D (r 2) (o 0) = 0, D (r 2) (o 1) = 0, D (r 2) (o 2) = 0 & D (r 2) (o 3) = 0] -> D = 0.
Proof.
move=> [a0 a1 a2 a3] [b0 b1 b2 b3] [c0 c1 c2 c3]; apply/matrixP=> i j; rewrite [RHS]mxE.
have -> : i = nth (r 0) [:: r 0; r 1; r 2] i by apply: val_inj; case: i => [[|[|[|]]]].
have -> : j = nth (o 0) [:: o 0; o 1; o 2; o 3] j by apply: val_inj; case: j => [[|[|[|[|]]]]].
by case: i j => [[|[|[|//]]] ?] [[|[|[|[|//]]]] ?].
Qed.

Lemma local_one : (7 <= \rank (alone v F *m J [:: (v, a)] local_cameras))%N.
Proof.
pose at_ (k : 'I_5) := nth (r 0, o 0) [:: (r 0, o 0); (r 0, o 1); (r 0, o 2); (r 0, o 3); (r 1, o 1)] k.
suff : (12 <= \rank (alone v F *m J [:: (v, a)] local_cameras) + 5)%N by lia.
apply: (@rank_local _ _ at_) => D D0 /(_ _ (mem_head _ _)) /local_a [[d10 d20 d21 d12] [d22 d13 d23]].
have e k (k5 : (k < 5)%N) := D0 (Ordinal k5); have d11 : D (r 1) (o 1) = 0 := e 4%N isT.
by apply: entries_zero; split=> //; [exact: (e 0%N isT) | exact: (e 1%N isT) | exact: (e 2%N isT)
  | exact: (e 3%N isT) | rewrite d22].
Qed.

Lemma local_two (b' : 'I_n) : val b' = b ->
  (11 <= \rank (alone v F *m J [:: (v, a); (v, b')] local_cameras))%N.
Proof.
move=> bb; suff : (12 <= \rank (alone v F *m J [:: (v, a); (v, b')] local_cameras) + 1)%N by lia.
apply: (@rank_local _ _ (fun _ : 'I_1 => (r 0, o 0))) => D /(_ ord0) /= d00 h.
have /local_a [[d10 d20 d21 d12] [d22 d13 d23]] := h _ (mem_head _ _).
have /(local_b bb) [d01 d02 d03 d22'] : equation local_cameras (v, b') (delta_mx v 0 *m (mxvec D : 'rV_(3 * 4))) = 0.
  by apply: h; rewrite !inE eqxx orbT.
by apply: entries_zero; split=> //; rewrite -?d22 d22' d00.
Qed.
End Local.

(* ------------------------------------------------------------------ in numbers *)
Section Grow.
Variable n : nat.
Implicit Types (E T K : seq ('I_n * 'I_n)).

Lemma exchange (F : numFieldType) E T K (b : seq 'I_n) (P0 P1 : cameras F n) :
  (1 < size b)%N -> {subset T <= E} -> all (inside b) T -> all (inside b) K ->
  (11 * size b - 15 <= \rank (J T P0))%N -> exists P : cameras F n, (\rank (J (K ++ E) P1) <= \rank (J E P))%N.
Proof.
move=> sb TE Tb Kb h0; have [P [r0 r1]] := both_J T (K ++ E) P0 P1; exists P.
have /(theorem_5_9 P)/(_ TE) : {subset T <= T ++ K} by move=> e eT; rewrite mem_cat eT.
have : (\rank (J (T ++ K) P) <= 11 * size b - 15)%N by apply: rank_inside; rewrite // all_cat Tb.
have : (\rank (J (K ++ E) P) <= \rank (J ((T ++ K) ++ E) P))%N.
  by apply: J_mono => e; rewrite -catA !mem_cat => ->; rewrite orbT.
by lia.
Qed.

Lemma grow W d v E r (P1 : cameras rat_comRing n) : all (fun e => (e.1 != v) && (e.2 != v)) E ->
  (d <= \rank (alone v [numFieldType of rat] *m J W P1 : 'M[rat]_(_, _)))%N ->
  attained E r -> attained (W ++ E) (r + d).
Proof.
move=> out hd [P0 h0].
have [||P [r1 r2]] := @both [numFieldType of rat] _ _ _ _ _ _ (fun R U => J E U) (fun R U => alone v R *m J W U) P0 P1.
- by move=> t; rewrite map_J.
- by move=> t; rewrite map_mxM map_J map_alone.
by exists P; apply: leq_trans (extend W P out); apply: leq_add; [exact: leq_trans r1 | exact: leq_trans r2].
Qed.

Lemma grow_one v a E r : v != a -> all (fun e => (e.1 != v) && (e.2 != v)) E ->
  attained E r -> attained ((v, a) :: E) (r + 7).
Proof.
have no (w : 'I_n) : val w != n by rewrite neq_ltn ltn_ord.
by move=> va out; apply: grow out (local_one [numFieldType of rat] va (no v) (no a)).
Qed.

Lemma grow_two (v a b : 'I_n) E r : v != a -> v != b -> a != b -> all (fun e => (e.1 != v) && (e.2 != v)) E ->
  attained E r -> attained ((v, a) :: (v, b) :: E) (r + 11).
Proof. by move=> va vb ab out; apply: grow out (local_two [numFieldType of rat] va vb ab erefl). Qed.

(* Theorem 4.1, by rank: the pairs T make the nodes b a body, and a body holds all pairs of its nodes. *)
Theorem theorem_4_1 E T K (b : seq 'I_n) r : (1 < size b)%N -> all (either E) T -> all (inside b) T ->
  all (inside b) K -> attained T (11 * size b - 15) -> attained (K ++ E) r -> attained E r.
Proof.
move=> sb TE Tb Kb [P0 h0] KE; apply: (@attained_either _ (T ++ E)).
  by rewrite all_cat TE; apply/allP=> e eE; rewrite /either eE.
have [P1 h1] : attained (K ++ (T ++ E)) r.
  by apply: attained_mono KE => e; rewrite !mem_cat => /orP [-> //|->]; rewrite !orbT.
have TTE : {subset T <= T ++ E} by move=> e eT; rewrite mem_cat eT.
by have [P h] := exchange P1 sb TTE Tb Kb h0; exists P; apply: leq_trans h1 h.
Qed.
End Grow.
