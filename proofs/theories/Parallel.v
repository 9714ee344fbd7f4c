(* Theorem 4.8: directions determine the points iff N has the rank d n - (d+1); otherwise there are infinitely many points
   with these directions. It is linear, so nothing is cited. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Generic Counting Rigid Generically Directions Components.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import Order.POrderTheory GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Given.
Variables (F : fieldType) (n d : nat) (E : seq ('I_n * 'I_n)) (c : points F n d).
Implicit Types y : points F n d.

Lemma turned_same y e : same_directions E c y -> e \in E -> turned c e y = 0.
Proof. by move=> h /h [t _]; apply: turned_multiple. Qed.

(* (4.1): where displacements are not zero, motions of N are multiples of them *)
Lemma turned_zero y e : displacement c e != 0 -> turned c e y = 0 -> exists s, displacement y e = s *: displacement c e.
Proof.
case/rV0Pn=> h ch t0; exists (displacement y e 0 h / displacement c e 0 h); apply/rowP=> k; rewrite [RHS]mxE.
have := congr1 (fun m : 'M_d => m h k) t0; rewrite turnedE [RHS]mxE => /eqP; rewrite subr_eq0 => /eqP.
by move=> ek; rewrite -[LHS](mulKf ch) ek mulrA [_^-1 * _]mulrC.
Qed.

(* trivial motions, by rows *)
Lemma trivialP y : reflect (exists s t, forall v, row v y = s *: row v c + t) (mxvec y <= trivials c)%MS.
Proof.
apply: (iffP submxP) => [[u e] | [s [t h]]].
  by exists (lsubmx u 0 0), (rsubmx u) => v; rewrite -row_trivial -e mxvecK.
exists (row_mx s%:M t); apply: (can_inj vec_mxK); rewrite mxvecK; apply/row_matrixP=> v.
by rewrite row_trivial row_mxKl row_mxKr mxE eqxx mulr1n h.
Qed.

Lemma not_constant e : displacement c e != 0 -> \rank (trivials c) = d.+1.
Proof. by rewrite subr_eq0 => /rank_trivials. Qed.

Hypotheses (n1 : (1 < n)%N) (d1 : (1 < d)%N).

Lemma some_displacement : (d * n - d.+1 <= \rank (N E c))%N -> exists2 e, e \in E & displacement c e != 0.
Proof.
move=> full; case: (boolP (has (fun e => displacement c e != 0) E)) => [/hasP // | /hasPn none].
have large : (d * 2 <= d * n)%N by rewrite leq_mul2l n1 orbT.
suff N0 : N E c = 0 by move: full; rewrite N0 mxrank0; lia.
apply/row_matrixP=> k; rewrite row0 rowE; apply/eqP; rewrite N_ker; apply/allP=> e /none; rewrite negbK => /eqP c0.
by apply/eqP/matrixP=> a b; rewrite turnedE c0 !mxE mul0r mulr0 subrr.
Qed.

(* (a) => (b) *)
Theorem full_rank_unique : (d * n - d.+1 <= \rank (N E c))%N -> forall y, same_directions E c y -> same_points c y.
Proof.
move=> full y same; have [e eE ce] := some_displacement full.
have : (trivials c == kermx (N E c))%MS.
  have sub : (trivials c <= kermx (N E c))%MS by apply/sub_kermxP; exact: trivials_N.
  rewrite -(geq_leqif (mxrank_leqif_eq sub)) mxrank_ker (not_constant ce).
  by have := rank_leq_row (N E c); move: full; move: (\rank (N E c)) => r; lia.
case/andP=> _ sub; have /trivialP [s [t h]] : (mxvec y <= trivials c)%MS.
  by apply: submx_trans sub; rewrite N_kerP mxvecK; apply/allP=> f /(turned_same same) ->.
exists s; last by exists t.
have [t' t0 et] := same e eE; rewrite (displacement_trivial _ h) in et.
by apply: contraNneq t0 => s0; move: et; rewrite s0 scale0r => /esym/eqP; rewrite scaler_eq0 (negbTE ce) orbF.
Qed.
End Given.

(* not (a) => not (c): as many different points as one likes *)
Section Many.
Variables (F : numFieldType) (n d : nat) (E : seq ('I_n * 'I_n)) (c : points F n d).
Implicit Types y : points F n d.
Hypotheses (n1 : (1 < n)%N) (d1 : (1 < d)%N).
Hypothesis distinct : forall e, e \in E -> displacement c e != 0.
Variable f : 'I_n * 'I_n.
Hypothesis apart : displacement c f != 0.

Lemma moving : (\rank (N E c) < d * n - d.+1)%N -> exists y, (mxvec y <= kermx (N E c))%MS && ~~ (mxvec y <= trivials c)%MS.
Proof.
move=> less; have : ~~ (kermx (N E c) <= trivials c)%MS.
  apply/negP=> /mxrankS; rewrite mxrank_ker; have := rank_leq_row (trivials c); lia.
by case/row_subPn=> i ni; exists (vec_mx (row i (kermx (N E c)))); rewrite vec_mxK row_sub.
Qed.

Theorem less_rank_near : (\rank (N E c) < d * n - d.+1)%N -> forall k, exists ys : seq (points F n d),
  [/\ size ys = k, forall y, y \in ys -> forall e, e \in E -> exists2 t, `|t - 1| < 1 & displacement y e = t *: displacement c e
    & forall i j, (i < k)%N -> (j < k)%N -> same_points (nth 0 ys i) (nth 0 ys j) -> i = j].
Proof.
move=> /moving [y /andP [ky ny]] k.
have scale e : e \in E -> exists s, displacement y e == s *: displacement c e.
  move=> eE; have [|s h] := turned_zero (y := y) (distinct eE); last by exists s; rewrite h.
  by move: ky; rewrite N_kerP mxvecK => /allP /(_ e eE) /eqP.
pose s_of e : F := if @idP (e \in E) is ReflectT eE then xchoose (scale e eE) else 0.
have s_ofP e : e \in E -> displacement y e = s_of e *: displacement c e.
  by rewrite /s_of; case: {-}_ / idP => // eE _; apply/eqP/(xchooseP (scale e eE)).
pose S := 1 + \sum_(e <- E) `|s_of e|.
have S0 : 0 < S by rewrite ltr_spaddl // sumr_ge0.
pose x_ i : F := (S * i.+1%:R)^-1; have xp i : 0 < x_ i by rewrite invr_gt0 mulr_gt0 // ltr0n.
pose xs := [seq x_ i | i <- iota 0 k]; have sx : size xs = k by rewrite size_map size_iota.
have ux : uniq xs.
  rewrite map_inj_uniq ?iota_uniq // => i j /invr_inj /(mulfI (lt0r_neq0 S0)) /eqP; rewrite eqr_nat eqSS => /eqP.
  by [].
exists [seq c + x *: y | x <- xs]; split; first by rewrite size_map.
  move=> _ /mapP [x /mapP [i _ ->] ->] e eE; exists (1 + s_of e * x_ i); last first.
    by rewrite addrC displacementP s_ofP // scalerA -[X in _ + X]scale1r -scalerDl addrC [x_ i * _]mulrC.
  rewrite addrAC subrr add0r normrM (gtr0_norm (xp i)) ltr_pdivr_mulr ?mulr_gt0 ?ltr0n // mul1r.
  apply: le_lt_trans (_ : `|s_of e| <= S - 1) _.
    by rewrite /S addrC addKr (big_rem e) //= ler_addl sumr_ge0.
  by rewrite ltr_subl_addr ltr_spaddr // ler_pmulr // ler1n.
have row_moved x v : row v (c + x *: y) = row v c + x *: row v y by rewrite linearD /= linearZ.
move=> i j ik jk; rewrite !(nth_map 0) ?sx // => -[s s0 [t h]].
set x := nth 0 xs i in h; set x' := nth 0 xs j in h.
have {}h v : (x' - s * x) *: row v y = (s - 1) *: row v c + t.
  apply/rowP=> a; have := congr1 (fun r : 'rV_d => r 0 a) (h v); rewrite !row_moved !mxE.
  move: (c v a) (y v a) (t 0 a) => c1 y1 t1 e; apply/eqP; rewrite -subr_eq0; apply/eqP.
  by rewrite -[RHS](subrr (c1 + x' * y1)) {2}e; ring.
have x0 : x' = s * x.
  apply/eqP; rewrite -subr_eq0; apply: contraR ny => nz; apply/trivialP.
  exists ((x' - s * x)^-1 * (s - 1)), ((x' - s * x)^-1 *: t) => v.
  by rewrite -scalerA -scalerDr -h scalerA mulVf // scale1r.
have s1 : s = 1.
  apply/eqP; rewrite -subr_eq0; apply: contraR apart => nz.
  have z v : (s - 1) *: row v c + t = 0 by rewrite -h x0 subrr scale0r.
  have := congr2 (fun a b => a - b) (z f.1) (z f.2); rewrite subr0 opprD addrACA subrr addr0 -scalerBr => /eqP.
  by rewrite scaler_eq0 (negbTE nz).
by move: x0; rewrite s1 mul1r => /eqP; rewrite nth_uniq ?sx // => /eqP ->.
Qed.

Theorem less_rank_many : (\rank (N E c) < d * n - d.+1)%N -> forall k, exists ys : seq (points F n d),
  [/\ size ys = k, forall y, y \in ys -> same_directions E c y
    & forall i j, (i < k)%N -> (j < k)%N -> same_points (nth 0 ys i) (nth 0 ys j) -> i = j].
Proof.
move=> /less_rank_near near k; have [ys [size_ys same diff]] := near k; exists ys; split=> // y /same h e /h [t t1 dt].
by exists t => //; apply: contraTneq t1 => ->; rewrite sub0r normrN normr1 ltxx.
Qed.
End Many.

(* With signs: the directions of rays, not of lines *)
Section Signs.
Variables (F : realFieldType) (n d : nat) (E : seq ('I_n * 'I_n)) (c : points F n d).
Hypotheses (n1 : (1 < n)%N) (d1 : (1 < d)%N).
Definition same_rays (y : points F n d) := forall e, e \in E -> exists2 t : F, 0 < t & displacement y e = t *: displacement c e.

Theorem full_rank_rays : (d * n - d.+1 <= \rank (N E c))%N -> forall y, same_rays y ->
  exists2 s : F, 0 < s & exists t : 'rV_d, forall v, row v y = s *: row v c + t.
Proof.
move=> full y rays; have [e eE ce] := some_displacement n1 d1 full; have [t t0 et] := rays e eE.
have [|s _ [u h]] := full_rank_unique n1 d1 full (y := y).
  by move=> f /rays [x x0 fx]; exists x; rewrite ?lt0r_neq0.
exists s; last by exists u.
suff -> : s = t by []; have : (s - t) *: displacement c e == 0 by rewrite scalerBl -(displacement_trivial e h) et subrr.
by rewrite scaler_eq0 (negbTE ce) orbF subr_eq0 => /eqP.
Qed.

Theorem less_rank_rays f : (forall e, e \in E -> displacement c e != 0) -> displacement c f != 0 ->
  (\rank (N E c) < d * n - d.+1)%N -> forall k, exists ys : seq (points F n d),
  [/\ size ys = k, forall y, y \in ys -> same_rays y
    & forall i j, (i < k)%N -> (j < k)%N -> same_points (nth 0 ys i) (nth 0 ys j) -> i = j].
Proof.
move=> distinct apart less k; have [ys [size_ys same diff]] := less_rank_near n1 d1 distinct apart less k.
exists ys; split=> // y /same h e /h [t t1 dt]; exists t => //.
by move: t1; rewrite ltr_distl subrr => /andP [].
Qed.
End Signs.

(* ------------------------------------------------------------------ at generic points *)
Section Generic.
Variables (n d : nat).

Lemma poly_N (E : seq ('I_n * 'I_n)) : @polynomial_matrix n d _ _ (fun R c => N E c).
Proof.
move=> i j; case/mxvec_indexP: i => v a; case/mxvec_indexP: j => k l; case/mxvec_indexP: l => g h.
set e := tnth (in_tuple E) k; pose s : int := (e.1 == v)%:R - (e.2 == v)%:R.
have pd x : is_polynomial (fun R (c : 'M[R]_(n, d)) => displacement c e 0 x).
  by apply: poly_eq (poly_add (poly_entry e.1 x) (poly_opp (poly_entry e.2 x))) => R c; rewrite !mxE.
have pw x : is_polynomial (fun R (c : 'M[R]_(n, d)) => displacement (delta_mx v a : points R n d) e 0 x).
  apply: poly_eq (poly_number n d (s * (x == a)%:R)) => R c; rewrite !mxE rmorphM rmorphB !rmorph_nat mulrBl.
  by rewrite -!natrM !mulnb.
apply: poly_eq (poly_add (poly_mul (pd g) (pw h)) (poly_opp (poly_mul (pw g) (pd h)))) => R c.
by rewrite [RHS]mxE /= mxvecE mxE vec_mx_delta mxvecE turnedE.
Qed.

Lemma generic_displacement (i j : 'I_n) : (0 < d)%N -> i != j ->
  @generically n d (fun F c => displacement (c : points F n d) (i, j) != 0).
Proof.
move=> d0 ij; pose h : 'I_d := Ordinal d0.
have [q qE] := poly_add (poly_entry i h) (poly_opp (poly_entry j h)); exists q => [|F c].
  by exists (delta_mx i h); rewrite qE !mxE !eqxx [j == i]eq_sym (negbTE ij) andFb oppr0 addr0 oner_eq0.
by rewrite qE; apply: contraNneq => e; have := congr1 (fun r : 'rV_d => r 0 h) e; rewrite !mxE => ->.
Qed.

Variable G : seq (nat * nat).
Hypotheses (good : well_formed n G) (d1 : (1 < d)%N).

Theorem full_rank_determines : (exists c : points rat_comRing n d, (d * n - d.+1 <= \rank (N (edges n G) c : 'M[rat]_(_, _)))%N) ->
  directions_determine d n G.
Proof.
case=> c0 h; split=> //; apply: generically_impl (rank_generically (@poly_N (edges n G)) h) => F c full.
by apply: full_rank_unique full; case/and3P: good.
Qed.

Lemma edges_distinct (F : fieldType) (c : points F n d) : (forall i j, i != j -> displacement c (i, j) != 0) ->
  forall e, e \in edges n G -> displacement c e != 0.
Proof.
move=> h [i j]; rewrite edgesE => ijG; apply: h; case/and3P: good => _ /allP /(_ _ ijG) /andP [/= lt _] _.
by rewrite neq_ltn lt.
Qed.

Theorem determined_full_rank : directions_determine d n G ->
  exists c : points rat_comRing n d, (d * n - d.+1 <= \rank (N (edges n G) c : 'M[rat]_(_, _)))%N.
Proof.
case=> _ det.
have apart : @generically n d (fun F c => forall e, e \in enum {: 'I_n * 'I_n} -> e.1 != e.2 -> displacement (c : points F n d) e != 0).
  apply: (@generically_all n d _ _ (fun e F c => e.1 != e.2 -> displacement (c : points F n d) e != 0)) => -[i j] _ /=.
  case: (eqVneq i j) => [_|ij]; first exact: generically_true.
  by apply: generically_impl (generic_displacement (ltnW d1) ij) => F c.
have [q [c nz] both] := generically_and det apart; have [unique {}apart] := both [numFieldType of rat] c nz.
have n1 : (1 < n)%N by case/and3P: good.
pose f := (Ordinal (ltnW n1), Ordinal n1).
have cf : displacement c f != 0 by apply: apart; rewrite ?mem_enum.
have ce : forall e, e \in edges n G -> displacement (c : points [fieldType of rat] n d) e != 0.
  by apply: edges_distinct => i j ij; apply: apart; rewrite ?mem_enum.
exists c; rewrite leqNgt; apply/negP=> less.
have [ys [sy same diff]] := less_rank_many n1 d1 ce cf less 2.
have [y0 y1] : nth 0 ys 0 \in ys /\ nth 0 ys 1 \in ys by rewrite !mem_nth ?sy.
suff : 0%N = 1%N by []; apply: diff => //.
have [s s0 [t h]] := unique _ (same _ y0); have [s' s'0 [t' h']] := unique _ (same _ y1).
exists (s' / s); first by rewrite mulf_neq0 ?invr_eq0.
exists (t' - (s' / s) *: t) => v; rewrite h h' scalerDr scalerA divfK // -addrA [_ *: t + _]addrC subrK.
by [].
Qed.
End Generic.

(* Theorem 4.8 in the words of Statement.v *)
Theorem calibrated_determined n G : well_formed n G -> full_rank Calibrated n G <-> directions_determine 3 n G.
Proof.
move=> good; split=> [[_ low _] | /(@determined_full_rank n 3 G good isT) low]; first exact: (@full_rank_determines n 3 G good isT low).
by split=> // F c; apply: (@lemma_3_4 _ n 3); case/and3P: good.
Qed.
Theorem affine_determined n G : well_formed n G -> full_rank Affine n G <-> directions_determine 2 n G.
Proof.
move=> good; split=> [[_ low _] | /(@determined_full_rank n 2 G good isT) low]; first exact: (@full_rank_determines n 2 G good isT low).
by split=> // F c; apply: (@lemma_3_4 _ n 2); case/and3P: good.
Qed.
