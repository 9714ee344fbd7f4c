(* Sections 3, 4 and 13: known directions. N is linear, holds the trivial motions s c_v + t, and whether they are all
   there is decides whether directions determine the points (Theorem 4.8). *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Generic Counting Rigid Generically.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Linear.
Variables (R : comRingType) (n d : nat).
Implicit Types (c y z : points R n d) (E : seq ('I_n * 'I_n)) (t : 'rV[R]_d).

Lemma displacementP a y z e : displacement (a *: y + z) e = a *: displacement y e + displacement z e.
Proof.
apply/rowP=> k; rewrite /displacement !mxE.
by move: (y e.1 k) (y e.2 k) (z e.1 k) (z e.2 k) => y1 y2 z1 z2; ring.
Qed.

(* entries of [turned]: the 2 x 2 minors of both displacements *)
Lemma turnedE c e y h k : turned c e y h k =
  displacement c e 0 h * displacement y e 0 k - displacement y e 0 h * displacement c e 0 k.
Proof. by rewrite /turned !mxE !big_ord1 !mxE. Qed.

Lemma turned_is_linear c e : linear (turned c e).
Proof.
move=> a y z; apply/matrixP=> h k; rewrite [RHS]mxE [X in _ = X + _]mxE !turnedE displacementP.
move: (displacement c e) (displacement y e) (displacement z e) => u v w; rewrite !mxE.
by move: (u 0 h) (u 0 k) (v 0 h) (v 0 k) (w 0 h) (w 0 k) => u1 u2 v1 v2 w1 w2; ring.
Qed.
Canonical turned_linear c e := Linear (@turned_is_linear c e).

Definition Nfun E c y := \matrix_(k < size E) mxvec (turned c (tnth (in_tuple E) k) y).
Lemma Nfun_is_linear E c : linear (Nfun E c).
Proof. by move=> a y z; apply/row_matrixP=> i; rewrite linearP /= !rowK !linearP. Qed.
Canonical Nfun_linear E c := Linear (@Nfun_is_linear E c).

Lemma N_lin E c : N E c = lin_mx (Nfun E c). Proof. by []. Qed.

Lemma N_ker E c u : (u *m N E c == 0) = all (fun e => turned c e (vec_mx u) == 0) E.
Proof.
rewrite N_lin mul_rV_lin mxvec_eq0; apply/eqP/allP => [h e eE | h].
  have k : (index e E < size E)%N by rewrite index_mem.
  have ek : tnth (in_tuple E) (Ordinal k) = e by rewrite (tnth_nth e) /= nth_index.
  by have := congr1 (row (Ordinal k)) h; rewrite rowK ek row0 => /eqP; rewrite mxvec_eq0.
apply/row_matrixP=> k; rewrite rowK row0 (eqP (h _ _)) ?linear0 //.
exact: mem_tnth.
Qed.

Lemma displacement_swap y (i j : 'I_n) : displacement y (j, i) = - displacement y (i, j).
Proof. by rewrite /displacement opprB. Qed.
Lemma turned_swap c y (i j : 'I_n) : turned c (j, i) y = turned c (i, j) y.
Proof.
apply/matrixP=> h k; rewrite !turnedE !(displacement_swap _ i j).
move: (displacement c _) (displacement y _) => u w; rewrite !mxE.
by move: (u 0 h) (u 0 k) (w 0 h) (w 0 k) => u1 u2 w1 w2; ring.
Qed.

(* multiples of the displacement turn nothing *)
Lemma turned_multiple c e y s : displacement y e = s *: displacement c e -> turned c e y = 0.
Proof.
by move=> h; apply/matrixP=> a b; rewrite turnedE h !mxE; move: (displacement c e 0 a) (displacement c e 0 b) => u w; ring.
Qed.
Lemma displacement_trivial c y s t e : (forall v, row v y = s *: row v c + t) -> displacement y e = s *: displacement c e.
Proof. by move=> h; rewrite /displacement !h scalerBr opprD addrACA subrr addr0. Qed.

(* Lemma 3.4 (a): the trivial motions y_v = s c_v + t *)
Definition trivial_motion c (u : 'rV[R]_(1 + d)) : 'rV[R]_(n * d) :=
  mxvec (lsubmx u 0 0 *: c + \matrix_v rsubmx u).
Lemma trivial_motion_is_linear c : linear (trivial_motion c).
Proof.
move=> a u v; rewrite /trivial_motion -mxvecP; congr mxvec; apply/matrixP=> i j; rewrite !mxE.
by move: (u 0 _) (v 0 _) (u 0 _) (v 0 _) (c i j) => u1 v1 u2 v2 x; ring.
Qed.
Canonical trivial_motion_linear c := Linear (@trivial_motion_is_linear c).
Definition trivials c := lin1_mx (trivial_motion c).
Lemma row_trivial c (u : 'rV[R]_(1 + d)) v :
  row v (vec_mx (u *m trivials c) : points R n d) = lsubmx u 0 0 *: row v c + rsubmx u.
Proof. by rewrite mul_rV_lin1 /= mxvecK linearD /= linearZ /= rowK. Qed.
Lemma trivials_N E c : trivials c *m N E c = 0.
Proof.
apply/row_matrixP=> i; rewrite row_mul row0 rowE; apply/eqP; rewrite N_ker; apply/allP=> e _; apply/eqP.
exact/turned_multiple/(displacement_trivial _ (row_trivial c _)).
Qed.
End Linear.

Section Morphism.
Variables (R S : comRingType) (f : {rmorphism R -> S}) (n d : nat).
Local Notation "A ^f" := (map_mx f A).

Lemma map_displacement (y : points R n d) e : (displacement y e)^f = displacement y^f e.
Proof. by rewrite /displacement map_mxB !map_row. Qed.
Lemma map_turned (c y : points R n d) e : (turned c e y)^f = turned c^f e y^f.
Proof. by rewrite /turned -!map_displacement map_mxB !map_mxM !map_trmx. Qed.
Lemma map_N E (c : points R n d) : (N E c)^f = N E c^f.
Proof. by rewrite !N_lin; apply: map_lin_mx => A; apply/row_matrixP=> k; rewrite -map_row !rowK map_mxvec map_turned. Qed.
Lemma map_trivials (c : points R n d) : (trivials c)^f = trivials c^f.
Proof.
apply: map_lin1_mx => u; rewrite /trivial_motion map_mxvec; congr mxvec; apply/matrixP=> i j.
by rewrite !mxE rmorphD rmorphM.
Qed.
End Morphism.

(* ------------------------------------------------------------------ ranks of N *)
Section Ranks.
Variables (F : fieldType) (n d : nat).
Implicit Types (E : seq ('I_n * 'I_n)) (c y : points F n d).

Lemma N_kerP E c (u : 'rV_(n * d)) : (u <= kermx (N E c))%MS = all (fun e => turned c e (vec_mx u) == 0) E.
Proof. by rewrite -N_ker; apply/sub_kermxP/eqP. Qed.
Lemma N_ker_mono E1 E2 c : {subset E1 <= E2} -> (kermx (N E2 c) <= kermx (N E1 c))%MS.
Proof. by move=> sub; apply/rV_subP=> u; rewrite !N_kerP => /allP h; apply/allP=> e /sub/h. Qed.
Lemma N_mono E1 E2 c : {subset E1 <= E2} -> (\rank (N E1 c) <= \rank (N E2 c))%N.
Proof. by move=> sub; apply: rank_by_ker; apply: N_ker_mono. Qed.
Lemma N_nil c : \rank (N [::] c) = 0%N.
Proof. by apply/eqP; rewrite mxrank_eq0; apply/eqP/matrixP=> i [j []]. Qed.

(* Theorem 5.9: rank is submodular *)
Lemma N_submodular E1 E2 E0 c : {subset E0 <= E1} -> {subset E0 <= E2} ->
  (\rank (N (E1 ++ E2) c) + \rank (N E0 c) <= \rank (N E1 c) + \rank (N E2 c))%N.
Proof.
move=> s1 s2; set K1 := kermx (N E1 c); set K2 := kermx (N E2 c).
have h : (K1 :&: K2 <= kermx (N (E1 ++ E2) c))%MS.
  by apply/rV_subP=> u; rewrite sub_capmx !N_kerP all_cat.
have k : (K1 + K2 <= kermx (N E0 c))%MS by rewrite addsmx_sub !N_ker_mono.
have := mxrankS h; have := mxrankS k; have := mxrank_sum_cap K1 K2.
rewrite !mxrank_ker; have := rank_leq_row (N E1 c); have := rank_leq_row (N E2 c).
by have := rank_leq_row (N E0 c); have := rank_leq_row (N (E1 ++ E2) c); lia.
Qed.

(* points s_0, .., s_(k-1) of the n, and pairs of their positions *)
Section Some.
Variables (k : nat) (s : 'I_k -> 'I_n).
Lemma displacement_rowsub y i j : displacement (rowsub s y) (i, j) = displacement y (s i, s j).
Proof. by rewrite /displacement !row_rowsub. Qed.
Lemma N_local (E : seq ('I_k * 'I_k)) c : (\rank (N (moved s E) c) <= \rank (N E (rowsub s c)))%N.
Proof.
apply: leq_trans (mxrankM_maxr (lin_mx (rowsub s)) _).
apply: rank_by_ker; apply/rV_subP=> u /sub_kermxP; rewrite mulmxA => /eqP.
rewrite N_ker N_kerP => /allP h; apply/allP=> _ /mapP [[i j] /h + ->].
by rewrite mul_rV_lin mxvecK /turned !displacement_rowsub.
Qed.
End Some.
End Ranks.

Section Placing.
Variables (F : fieldType) (n k d : nat) (s : 'I_k -> 'I_n).
Hypothesis s_inj : injective s.
Lemma displacement_place (y : points F k d) i j : displacement (place F s *m y : points F n d) (s i, s j) = displacement y (i, j).
Proof.
rewrite /displacement !row_mul; have e h : row (s h) (place F s) = delta_mx 0 h.
  by apply/rowP=> l; rewrite !mxE /= (inj_eq s_inj) [l == h]eq_sym.
by rewrite !e -!rowE.
Qed.
Lemma N_place (E : seq ('I_k * 'I_k)) (c : points F k d) : (\rank (N E c) <= \rank (N (moved s E) (place F s *m c)))%N.
Proof.
apply: leq_trans (mxrankM_maxr (lin_mx (mulmx (place F s))) _).
apply: rank_by_ker; apply/rV_subP=> u /sub_kermxP; rewrite mulmxA => /eqP.
rewrite N_ker N_kerP => /allP h; apply/allP=> -[i j] eE.
by have := h _ (map_f _ eE); rewrite mul_rV_lin mxvecK /turned !displacement_place.
Qed.
End Placing.

(* ------------------------------------------------------------------ at all points *)
Section Everywhere.
Variables (F : numFieldType) (n d : nat).
Implicit Types (E : seq ('I_n * 'I_n)) (c : points F n d).

Lemma both_N E1 E2 c0 c1 :
  exists c, (\rank (N E1 c0) <= \rank (N E1 c))%N /\ (\rank (N E2 c1) <= \rank (N E2 c))%N.
Proof.
by apply: (@both F n d _ _ _ _ (fun R U => N E1 U) (fun R U => N E2 U) c0 c1) => t; rewrite map_N.
Qed.
End Everywhere.

(* Different points have d + 1 trivial motions. *)
Lemma rank_trivials (F : fieldType) n d (c : points F n d) (i j : 'I_n) : row i c != row j c -> \rank (trivials c) = d.+1.
Proof.
move=> ij; apply/eqP; rewrite -/(1 + d)%N -/(row_free _) -kermx_eq0 -submx0; apply/rV_subP=> u /sub_kermxP u0.
have h v : lsubmx u 0 0 *: row v c + rsubmx u = 0 by rewrite -row_trivial u0 !linear0.
have s0 : lsubmx u 0 0 = 0.
  have := congr2 (fun x y => x - y) (h i) (h j); rewrite subr0 opprD addrACA subrr addr0 -scalerBr => /eqP.
  by rewrite scaler_eq0 subr_eq0 (negbTE ij) orbF => /eqP.
have t0 : rsubmx u = 0 by have := h i; rewrite s0 scale0r add0r.
rewrite submx0 -[u]hsubmxK t0; apply/eqP/rowP=> k; rewrite !mxE; case: (split k) => l; rewrite ?mxE //.
by rewrite ord1 -[RHS]s0 mxE.
Qed.

(* Lemma 3.4 (a), at all points, whether or not some coincide *)
Theorem lemma_3_4 (F : fieldType) n d (E : seq ('I_n * 'I_n)) (c : points F n d) : (1 < n)%N -> (0 < d)%N ->
  (\rank (N E c) <= d * n - d.+1)%N.
Proof.
move=> n1 d0; case: (boolP [exists i, exists j, row i c != row j c]) => [/existsP [i /existsP [j /rank_trivials rt]] | ].
  by have := mulmx0_rank_max (trivials_N E c); rewrite rt; lia.
rewrite negb_exists => /forallP same; suff -> : N E c = 0 by rewrite mxrank0.
apply/row_matrixP=> k; rewrite row0 rowE; apply/eqP; rewrite N_ker; apply/allP=> e _; apply/eqP.
have c0 : displacement c e = 0.
  by have := same e.1; rewrite negb_exists => /forallP/(_ e.2); rewrite negbK => /eqP; rewrite /displacement => ->; rewrite subrr.
by apply/matrixP=> a b; rewrite turnedE c0 !mxE; ring.
Qed.

(* the pairs among some nodes *)
Lemma N_inside (F : fieldType) n d b (E : seq ('I_n * 'I_n)) (c : points F n d) : (1 < size b)%N -> (0 < d)%N ->
  all (inside b) E -> (\rank (N E c) <= d * size b - d.+1)%N.
Proof.
move=> sb d0 /allP ins; pose s := tnth (in_tuple b).
pose A := moved s (enum {: 'I_(size b) * 'I_(size b)}).
apply: leq_trans (_ : _ <= \rank (N A c))%N _.
  apply: N_mono => -[x y] /ins /andP [] /= /(tnthP (in_tuple b)) [i ->] /(tnthP (in_tuple b)) [j ->].
  by apply/mapP; exists (i, j); rewrite ?mem_enum.
exact: leq_trans (N_local _ _ _) (lemma_3_4 _ _ sb d0).
Qed.

Lemma N_either (F : fieldType) n d (E1 E2 : seq ('I_n * 'I_n)) (c : points F n d) : all (either E2) E1 ->
  (\rank (N E1 c) <= \rank (N E2 c))%N.
Proof.
move=> /allP sub; apply: rank_by_ker; apply/rV_subP=> u; rewrite !N_kerP => /allP h.
apply/allP=> -[x y] /sub /orP [/h // | /h]; by rewrite /swap /= turned_swap.
Qed.

(* ------------------------------------------------------------------ a node is added *)
Section Extend.
Variables (n d : nat) (v : 'I_n).

(* motions of node v alone *)
Definition alone_fun (R : comRingType) (x : 'rV[R]_d) := mxvec (delta_mx v 0 *m x : points R n d).
Lemma alone_is_linear (R : comRingType) : linear (@alone_fun R).
Proof. by move=> a x y; rewrite /alone_fun mulmxDr -scalemxAr linearP. Qed.
Canonical alone_linear (R : comRingType) := Linear (@alone_is_linear R).
Definition alone_at (R : comRingType) := lin1_mx (@alone_fun R).
Lemma map_alone_at (R S : comRingType) (f : {rmorphism R -> S}) : map_mx f (alone_at R) = alone_at S.
Proof. by apply: map_lin1_mx => x; rewrite /alone_fun map_mxvec map_mxM map_delta_mx. Qed.

Lemma displacement_alone (R : comRingType) (x : 'rV[R]_d) e :
  displacement (delta_mx v 0 *m x : points R n d) e = ((e.1 == v)%:R - (e.2 == v)%:R) *: x.
Proof.
have r w : row w (delta_mx v 0 *m x) = (w == v)%:R *: x.
  by apply/rowP=> k; rewrite !mxE big_ord1 !mxE !ord1 eqxx andbT.
by rewrite /displacement !r scalerBl.
Qed.

Lemma N_extend (F : numFieldType) E W (c : points F n d) : all (fun e => (e.1 != v) && (e.2 != v)) E ->
  (\rank (N E c) + \rank (alone_at F *m N W c) <= \rank (N (W ++ E) c))%N.
Proof.
move=> /allP out; set K := kermx (N E c).
have aK : (alone_at F <= K)%MS.
  apply/rV_subP=> _ /submxP [x ->]; rewrite N_kerP; apply/allP=> e /out /andP [n1 n2].
  rewrite mul_rV_lin1 mxvecK; apply/eqP/(turned_multiple (s := 0)).
  by rewrite displacement_alone (negbTE n1) (negbTE n2) subrr !scale0r.
have : (\rank (alone_at F *m N W c) <= \rank (K *m N W c))%N := mxrankS (submxMr (N W c) aK).
have : (\rank (K *m N W c) + \rank (K :&: kermx (N W c)) = \rank K)%N := mxrank_mul_ker K (N W c).
have : (\rank (kermx (N (W ++ E) c)) <= \rank (K :&: kermx (N W c)))%N.
  by apply/mxrankS/rV_subP=> u; rewrite sub_capmx !N_kerP all_cat andbC.
rewrite /K !mxrank_ker; have := rank_leq_row (N E c); have := rank_leq_row (N (W ++ E) c); lia.
Qed.

(* at c_v = 0 *)
Lemma turned_alone (F : fieldType) (c : points F n d) (a : 'I_n) (x : 'rV_d) h k : v != a -> row v c = 0 ->
  turned c (v, a) (delta_mx v 0 *m x) h k = c a k * x 0 h - c a h * x 0 k.
Proof.
move=> va c0; rewrite turnedE displacement_alone /displacement c0 eqxx /= eq_sym (negbTE va) subr0 scale1r !mxE.
by move: (c a h) (c a k) (x 0 h) (x 0 k) => p q r s; ring.
Qed.
End Extend.

(* c_v = 0, c_a = e_0, c_b = e_1 *)
Section Local.
Variables (F : numFieldType) (n d : nat) (v a : 'I_n).
Hypothesis va : v != a.
Let o0 : 'I_d.+2 := ord0.
Let o1 : 'I_d.+2 := lift ord0 ord0.

Lemma N_alone E (c : points F n d.+2) (x : 'rV_d.+2) : x *m (alone_at d.+2 v F *m N E c) = 0 ->
  forall e, e \in E -> turned c e (delta_mx v 0 *m x) = 0.
Proof. by rewrite mulmxA mul_rV_lin1 => /eqP; rewrite N_ker mxvecK => /allP h e /h /eqP. Qed.

Lemma one_at : (d.+1 <= \rank (alone_at d.+2 v F *m N [:: (v, a)] (delta_mx a o0 : points F n d.+2)))%N.
Proof.
set c := delta_mx a o0; suff : (d.+2 <= \rank (alone_at d.+2 v F *m N [:: (v, a)] c) + 1)%N by lia.
have c0 : row v c = 0 by apply/rowP=> k; rewrite !mxE (negbTE va).
apply: (rank_by_coordinates (C := delta_mx o0 0 : 'M_(_, 1))) => x /N_alone /(_ _ (mem_head _ _)) h.
rewrite -colE => /matrixP/(_ 0 0); rewrite !mxE => x0; apply/rowP=> k; rewrite [RHS]mxE.
have := congr1 (fun m : 'M_d.+2 => m o0 k) h; rewrite turned_alone // x0 !mxE eqxx mulr0 sub0r mul1r => /eqP.
by rewrite oppr_eq0 => /eqP.
Qed.

Variable b : 'I_n.
Hypotheses (vb : v != b) (ab : a != b).
Lemma two_at : (d.+2 <= \rank (alone_at d.+2 v F *m N [:: (v, a); (v, b)] ((delta_mx a o0 + delta_mx b o1)%R : points F n d.+2)))%N.
Proof.
set c := _ + _; suff : (d.+2 <= \rank (alone_at d.+2 v F *m N [:: (v, a); (v, b)] c) + 0)%N by rewrite addn0.
have c0 : row v c = 0 by apply/rowP=> k; rewrite !mxE (negbTE va) (negbTE vb) addr0.
have ca k : c a k = (k == o0)%:R by rewrite !mxE eqxx (negbTE ab) addr0.
have cb k : c b k = (k == o1)%:R by rewrite !mxE eqxx eq_sym (negbTE ab) add0r.
apply: (rank_by_coordinates (C := 0 : 'M_(_, 0))) => x /N_alone h _; apply/rowP=> k; rewrite [RHS]mxE.
have {}h w i : (w == a) || (w == b) -> turned c (v, w) (delta_mx v 0 *m x) i k = 0.
  by move=> wab; rewrite h ?mxE // !inE !xpair_eqE eqxx.
case: (eqVneq k o0) => [k0|k0]; last first.
  have := h a o0; rewrite eqxx => /(_ isT); rewrite turned_alone // !ca (negbTE k0) eqxx mul0r mul1r sub0r => /eqP.
  by rewrite oppr_eq0 => /eqP.
have := h b o1; rewrite eqxx orbT => /(_ isT); rewrite turned_alone // !cb k0 eqxx mul0r mul1r sub0r => /eqP.
by rewrite oppr_eq0 => /eqP.
Qed.
End Local.

(* ------------------------------------------------------------------ in numbers *)
Section Grow.
Variables (n d : nat).
Implicit Types (E T K W : seq ('I_n * 'I_n)).
Local Notation at_ c E := (N E (c : points rat_comRing n d.+2) : 'M[rat]_(_, _)).

Definition seen E r : Prop := exists c : points rat_comRing n d.+2, (r <= \rank (at_ c E))%N.

Lemma seen_either E1 E2 r : all (either E2) E1 -> seen E1 r -> seen E2 r.
Proof. by move=> s [c h]; exists c; apply: leq_trans h (N_either c s). Qed.
Lemma seen_mono E1 E2 r : {subset E1 <= E2} -> seen E1 r -> seen E2 r.
Proof. by move=> s [c h]; exists c; apply: leq_trans h (N_mono c s). Qed.

Lemma grow_seen W k v E r (c1 : points rat_comRing n d.+2) : all (fun e => (e.1 != v) && (e.2 != v)) E ->
  (k <= \rank (alone_at d.+2 v [numFieldType of rat] *m N W c1 : 'M[rat]_(_, _)))%N -> seen E r -> seen (W ++ E) (r + k).
Proof.
move=> out hk [c0 h0].
have [||c [r1 r2]] := @both [numFieldType of rat] n d.+2 _ _ _ _ (fun R U => N E U) (fun R U => alone_at d.+2 v R *m N W U) c0 c1.
- by move=> t; rewrite map_N.
- by move=> t; rewrite map_mxM map_N map_alone_at.
by exists c; apply: leq_trans (N_extend W c out); apply: leq_add; [exact: leq_trans r1 | exact: leq_trans r2].
Qed.
Lemma seen_one v a E r : v != a -> all (fun e => (e.1 != v) && (e.2 != v)) E -> seen E r -> seen ((v, a) :: E) (r + d.+1).
Proof. by move=> va out; apply: grow_seen out (one_at [numFieldType of rat] d va). Qed.
Lemma seen_two (v a b : 'I_n) E r : v != a -> v != b -> a != b -> all (fun e => (e.1 != v) && (e.2 != v)) E ->
  seen E r -> seen ((v, a) :: (v, b) :: E) (r + d.+2).
Proof. by move=> va vb ab out; apply: grow_seen out (two_at [numFieldType of rat] d va vb ab). Qed.

(* Theorems 4.9 and 13.9, rule 4: a body holds all pairs of its nodes *)
Theorem rule_4 E T K (b : seq 'I_n) r : (1 < size b)%N -> all (either E) T -> all (inside b) T ->
  all (inside b) K -> seen T (d.+2 * size b - d.+3) -> seen (K ++ E) r -> seen E r.
Proof.
move=> sb TE Tb Kb [c0 h0] KE; apply: (@seen_either (T ++ E)).
  by rewrite all_cat TE; apply/allP=> e eE; rewrite /either eE.
have [c1 h1] : seen (K ++ (T ++ E)) r.
  by apply: seen_mono KE => e; rewrite !mem_cat => /orP [-> //|->]; rewrite !orbT.
have [c [r0 r1]] := @both_N [numFieldType of rat] n d.+2 T (K ++ (T ++ E)) c0 c1; exists c; apply: leq_trans h1 _.
have TTE : {subset T <= T ++ E} by move=> e eT; rewrite mem_cat eT.
have TTK : {subset T <= T ++ K} by move=> e eT; rewrite mem_cat eT.
have sub : (\rank (at_ c ((T ++ K) ++ (T ++ E))) + \rank (at_ c T) <= \rank (at_ c (T ++ K)) + \rank (at_ c (T ++ E)))%N.
  exact: N_submodular TTK TTE.
have up : (\rank (at_ c (T ++ K)) <= d.+2 * size b - d.+3)%N by apply: N_inside; rewrite // all_cat Tb.
apply: leq_trans r1 _.
have le : (\rank (at_ c (K ++ (T ++ E))) <= \rank (at_ c ((T ++ K) ++ (T ++ E))))%N.
  by apply: N_mono => e; rewrite !mem_cat => /or3P [->|->|->]; rewrite ?orbT.
apply: leq_trans le _; rewrite -(leq_add2r (\rank (at_ c T))); apply: leq_trans sub _; rewrite addnC leq_add2l.
exact: leq_trans up (leq_trans h0 r0).
Qed.
End Grow.

Lemma seen_moved n k d (s : 'I_k -> 'I_n) E r : injective s -> seen d E r -> seen d (moved s E) r.
Proof. by move=> i [c h]; exists (place [fieldType of rat] s *m c); apply: leq_trans h (N_place i E c). Qed.
