(* Section 4: which cameras have the same fundamental matrices, for given cameras: rules 1 and 3 of Theorem 4.1. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Differential Generic NormalForm Generically.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Edge.
Variable F : fieldType.
Hypothesis two0 : 2%:R != 0 :> F.
Implicit Types A B : 'M[F]_(3, 4).

Lemma skew_conj p q (Z : 'M[F]_(p, q)) (S : 'M_p) : S^T = - S -> (Z^T *m S *m Z)^T = - (Z^T *m S *m Z).
Proof. by move=> sk; rewrite !trmx_mul trmxK sk mulNmx mulmxN mulmxA. Qed.
Lemma skew_left p (Z : 'M[F]_p) (S : 'M_p) : S^T = - S -> S *m Z = S -> Z^T *m S = S.
Proof. by move=> sk e; rewrite -[S in LHS]opprK -sk mulmxN -trmx_mul e sk opprK. Qed.

(* Rule 1: an edge determines its cameras. *)
Theorem rule_1 A B A' B' t : row_free A -> row_free B -> row_free A' -> row_free B' -> (1 < \rank (fund A B))%N ->
  t != 0 -> fund A' B' = t *: fund A B ->
  exists2 H : 'M[F]_4, H \in unitmx & A' = A *m H /\ exists2 k : F, k != 0 & B' = k *: (B *m H).
Proof.
move=> fA fB fA' fB' r2 t0 same; set G := fund A B in r2 same.
have nz : G != 0 by rewrite -mxrank_eq0 -lt0n ltnW.
have nz' : fund A' B' != 0 by rewrite same scaler_eq0 negb_or t0.
have [full full'] := (distinct nz, distinct nz').
have sk0 := skew A B; cbv zeta in sk0; rewrite -/G in sk0.
have sk1 : (B'^T *m G *m A')^T = - (B'^T *m G *m A').
  have := skew A' B'; cbv zeta; rewrite same -scalemxAr -scalemxAl linearZ /= -scalerN.
  exact: (scalerI t0).
have [/row_freeP [X AX] /row_freeP [Y BY] /row_freeP [X' AX'] /row_freeP [Y' BY']] := And4 fA fB fA' fB'.
set S := B^T *m G *m A in sk0; set S' := B'^T *m G *m A' in sk1.
have [C AC rC] : exists2 C : 'M_4, A *m C = 0 & \rank C = 1%N.
  by exists (cokermx A); rewrite ?mulmx_coker // mxrank_coker (eqP fA).
pose m := B *m C.
have mG : (m^T <= kermx G)%MS.
  have SC : S *m C = 0 by rewrite /S -(mulmxA _ A C) AC mulmx0.
  have CS : C^T *m S = 0 by apply: trmx_inj; rewrite trmx_mul trmxK sk0 mulNmx SC oppr0 trmx0.
  by apply/sub_kermxP; apply: (row_free_inj fA); rewrite mul0mx /m trmx_mul -[RHS]CS /S !mulmxA.
have m0 : m != 0.
  apply/negP=> /eqP m0; have : (A + B <= kermx C)%MS by rewrite addsmx_sub; apply/andP; split; apply/sub_kermxP.
  by move/mxrankS; rewrite full mxrank_ker rC.
have ker1 : \rank (kermx G) = 1%N.
  have := mxrankS mG; rewrite mxrank_tr; have : (0 < \rank m)%N by rewrite lt0n mxrank_eq0.
  by rewrite mxrank_ker; have := rank_leq_row G; move: (\rank G) (\rank m) r2 => x y; clear; lia.
have rG : \rank G = 2%N by move: ker1 r2; rewrite mxrank_ker; have := rank_leq_row G; move: (\rank G) => x; clear; lia.
have SXA : S *m X *m A = S by rewrite /S -[_ *m A *m X]mulmxA AX mulmx1.
pose M := B *m X; pose N := M^T *m G.
have NE : N = X^T *m S *m X by rewrite /N /M /S trmx_mul -!mulmxA AX mulmx1.
have skN : N^T = - N by rewrite NE; exact: skew_conj.
have ANA : A^T *m N *m A = S.
  have e : (X *m A)^T *m S = S by apply: skew_left; rewrite // mulmxA.
  by rewrite NE -[RHS]SXA -[in RHS]e trmx_mul !mulmxA.
have S0 : S != 0.
  apply: contra nz => /eqP s0; apply/eqP; have : Y^T *m S *m X = G.
    by rewrite /S !mulmxA -trmx_mul BY trmx1 mul1mx -mulmxA AX mulmx1.
  by rewrite s0 mulmx0 mul0mx => <-.
have N0 : N != 0 by apply: contraNneq S0 => z; rewrite -ANA z mulmx0 mul0mx.
pose T := A'^T *m N *m A'.
have TE : X'^T *m T *m X' = N by rewrite /T !mulmxA -trmx_mul AX' trmx1 mul1mx -mulmxA AX' mulmx1.
have T0 : T != 0 by apply: contraNneq N0 => z; rewrite -TE z mulmx0 mul0mx.
have skT : T^T = - T by exact: skew_conj.
pose U := row_base (G *m A').
have rU : \rank (G *m A') = 2%N by rewrite mxrankMfree.
have inU k (Z : 'M_(k, 3)) : (Z *m (G *m A') <= U)%MS by rewrite eq_row_base submxMl.
have iS' : (S' <= U)%MS by rewrite /S' -mulmxA; exact: inU.
have iT : (T <= U)%MS by rewrite /T /N mulmxA -!mulmxA mulmxA; exact: inU.
have [x' ex'] := skew_span two0 rU sk1 iS'.
have [x ex] := skew_span two0 rU skT iT.
have x0 : x != 0 by apply: contraNneq T0 => z; rewrite ex z scale0r.
pose kap := x' / x.
have S'T : S' = kap *: T by rewrite ex ex' scalerA /kap divfK.
have BG : B'^T *m G = kap *: (A'^T *m N).
  by apply: (row_free_inj fA'); rewrite -scalemxAl; exact: S'T.
have kap0 : kap != 0.
  apply: contra nz => /eqP k0; apply/eqP; have : Y'^T *m (B'^T *m G) = G by rewrite mulmxA -trmx_mul BY' trmx1 mul1mx.
  by rewrite BG k0 scale0r mulmx0 => <-.
pose D := B' - kap *: (M *m A').
have DG : (D^T <= m^T)%MS.
  have : (kermx G <= m^T)%MS.
    by rewrite -(geq_leqif (mxrank_leqif_sup mG)) ker1 lt0n mxrank_eq0 trmx_eq0.
  apply: submx_trans; apply/sub_kermxP; rewrite /D linearB linearZ /= mulmxBl BG -scalemxAl trmx_mul -mulmxA.
  by rewrite -/N subrr.
have [W DW] : exists W, D = m *m W.
  by have /submxP [W e] := DG; exists W^T; rewrite -[D]trmxK e trmx_mul trmxK.
pose H := X *m A' + C *m (kap^-1 *: W).
have AH : A *m H = A' by rewrite /H mulmxDr mulmxA AX mul1mx mulmxA AC mul0mx addr0.
have BH : kap *: (B *m H) = B'.
  rewrite /H mulmxDr scalerDr !mulmxA -/M -/m -scalemxAr scalerA divff // scale1r -DW /D.
  by rewrite addrC subrK.
exists H; last by split=> //; exists kap.
rewrite -row_full_unit /row_full eqn_leq rank_leq_col -[X in (X <= _)%N]full'.
have : (A' + B' <= H)%MS.
  by rewrite addsmx_sub -AH -BH submxMl scalemx_sub // submxMl.
by move/mxrankS.
Qed.
End Edge.

Section Same.
Variables (F : fieldType) (n : nat).
Implicit Types (P Q : cameras F n) (b : seq 'I_n).

Lemma same_sub b b' P Q : {subset b' <= b} -> same_cameras P Q b -> same_cameras P Q b'.
Proof. by move=> s [H u h]; exists H => // v /s/h. Qed.

(* (x, y) |-> A x, B y, V (x + y): it is injective iff the centres of A, B and V are independent *)
Definition independence (R : comRingType) (A B V : 'M[R]_(3, 4)) : 'M[R]_(4 + 4, 3 + 3 + 3) :=
  col_mx (row_mx (row_mx A^T 0) V^T) (row_mx (row_mx 0 B^T) V^T).

Lemma independent A B V (X Y : 'M[F]_4) : row_free (independence A B V) ->
  X *m A^T = 0 -> Y *m B^T = 0 -> (X + Y) *m V^T = 0 -> X = 0.
Proof.
move=> free XA YB XYV; have : row_mx X Y *m independence A B V = 0.
  rewrite mul_row_col !mul_mx_row !mulmx0 add_row_mx add_row_mx addr0 add0r XA YB -mulmxDl XYV.
  by rewrite !row_mx0.
by move/eqP; rewrite mulmx_free_eq0 // row_mx_eq0 => /andP [/eqP].
Qed.

Lemma annihilator (A : 'M[F]_(3, 4)) p (X : 'M_(p, 4)) : row_free A -> X *m A^T = 0 -> (\rank X <= 1)%N.
Proof. by move=> f /sub_kermxP /mxrankS; rewrite mxrank_ker mxrank_tr (eqP f). Qed.

(* Bodies H1, H2, H3 of which each two share one of three nodes: only this is asked of the first one that it is a matrix. *)
Lemma three_bodies (A C V : 'M[F]_(3, 4)) (H1 H2 H3 : 'M[F]_4) s1 s2 t1 t3 w2 w3 : row_free A -> row_free C -> row_free V ->
  row_free (independence A C V) -> H3 \in unitmx -> t1 != 0 -> w2 != 0 ->
  s1 *: (A *m H1) = s2 *: (A *m H2) -> t1 *: (C *m H1) = t3 *: (C *m H3) -> w2 *: (V *m H2) = w3 *: (V *m H3) ->
  s1 *: H1 = s2 *: H2.
Proof.
move=> fa fc fv ind u3 t10 w20 e g k.
pose X := (s1 *: H1 - s2 *: H2)^T; pose Y := (t1 *: H1 - t3 *: H3)^T; pose Z := (w2 *: H2 - w3 *: H3)^T.
have zero (B : 'M[F]_(3, 4)) (x y : F) (K L : 'M_4) : x *: (B *m K) = y *: (B *m L) -> (x *: K - y *: L)^T *m B^T = 0.
  by move=> xy; rewrite -trmx_mul mulmxBr -!scalemxAr xy subrr trmx0.
have [XA YC ZV] : [/\ X *m A^T = 0, Y *m C^T = 0 & Z *m V^T = 0] by split; exact: zero.
have {zero} := And3 XA YC ZV.
have sum (kap : F) : kap = s1 * w2 * t3 - s2 * t1 * w3 -> kap *: H3^T = (t1 * w2) *: X - (s1 * w2) *: Y + (s2 * t1) *: Z.
  move=> ->; rewrite /X /Y /Z; apply/matrixP=> i j; rewrite !mxE.
  by move: (H1 j i) (H2 j i) (H3 j i) => *; ring.
have H12 : X = 0 -> s1 *: H1 = s2 *: H2.
  by move/eqP; rewrite /X trmx_eq0 subr_eq0 => /eqP.
move: X Y Z sum H12 {XA YC ZV} => X Y Z sum H12 [XA YC ZV].
have le1 (D : 'M[F]_(3, 4)) (K : 'M_4) z : row_free D -> K *m D^T = 0 -> (\rank (z *: K) <= 1)%N.
  by move=> f h; apply: annihilator f _; rewrite -scalemxAl h scaler0.
have {}sum := sum _ erefl; set kap := (X in X *: _) in sum.
have kap0 : kap = 0.
  apply/eqP; apply: contraT => k0; have r4 : \rank (kap *: H3^T) = 4%N.
    by rewrite mxrank_scale_nz // mxrank_tr mxrank_unit.
  have rX := le1 _ _ (t1 * w2) fa XA; have rY := le1 _ _ (- (s1 * w2)) fc YC; have rZ := le1 _ _ (s2 * t1) fv ZV.
  rewrite sum -scaleNr in r4.
  have := mxrank_add ((t1 * w2) *: X + - (s1 * w2) *: Y) ((s2 * t1) *: Z).
  have := mxrank_add ((t1 * w2) *: X) (- (s1 * w2) *: Y).
  rewrite r4; move: rX rY rZ; move: (\rank _) (\rank _) (\rank _) (\rank _) => r1 r2 r3 r5; clear; lia.
move: sum; rewrite kap0 scale0r => /esym/eqP; rewrite addr_eq0 => /eqP sum.
have X0 : (t1 * w2) *: X = 0.
  apply: (independent ind (Y := - ((s1 * w2) *: Y))); first by rewrite -scalemxAl XA scaler0.
    by rewrite mulNmx -scalemxAl YC scaler0 oppr0.
  by rewrite sum mulNmx -scalemxAl ZV scaler0 oppr0.
by apply: H12; apply/eqP; move/eqP: X0; rewrite scaler_eq0 mulf_eq0 (negbTE t10) (negbTE w20).
Qed.

(* Rule 3, for a node v that is joined to two nodes *)
Theorem rule_3 b a c v P Q : a \in b -> c \in b ->
  row_free (cam P a) -> row_free (cam P c) -> row_free (cam P v) ->
  row_free (independence (cam P a) (cam P c) (cam P v)) ->
  same_cameras P Q b -> same_cameras P Q [:: v; a] -> same_cameras P Q [:: v; c] -> same_cameras P Q (v :: b).
Proof.
move=> ab cb fa fc fv ind [H1 u1 h1] [H2 u2 h2] [H3 u3 h3].
have [s1 s10 e1] := h1 a ab; have [s2 s20 e2] := h2 a (mem_last v [:: a]).
have [t1 t10 g1] := h1 c cb; have [t3 t30 g3] := h3 c (mem_last v [:: c]).
have [w2 w20 k2] := h2 v (mem_head _ _); have [w3 w30 k3] := h3 v (mem_head _ _).
move: e2 g3 k3; rewrite e1 g1 k2 {e1 g1} => e g k.
have H12 : s1 *: H1 = s2 *: H2 := three_bodies fa fc fv ind u3 t10 w20 e g k.
exists H1 => // x; rewrite inE => /predU1P [->|/h1 //].
exists (w2 / s2 * s1); first by rewrite !mulf_neq0 // invr_eq0.
by rewrite k2 -scalerA (scalemxAr s1) H12 -scalemxAr scalerA divfK.
Qed.
End Same.

(* Theorem 10.3, rule 5: nodes v_1, v_2, v_3 between a and b, each with a body that holds it and a and with one that holds
   it and b *)
Section Biclique.
Variable F : fieldType.
Implicit Types A B C D V Q : 'M[F]_(3, 4).

(* u_1 A = u_2 B = u_3 C = u_4 D for no planes but 0 : the four centres are in no plane *)
Definition four_planes (R : comRingType) (A B C D : 'M[R]_(3, 4)) : 'M[R]_(3 + 3 + (3 + 3), 4 + 4 + 4) :=
  col_mx (col_mx (row_mx (row_mx A 0) 0) (row_mx (row_mx (- B) B) 0))
         (col_mx (row_mx (row_mx 0 (- C)) C) (row_mx (row_mx 0 0) (- D))).

Lemma no_plane A B C D (w : 'rV_4) : row_free (four_planes A B C D) ->
  (w <= A)%MS -> (w <= B)%MS -> (w <= C)%MS -> (w <= D)%MS -> w = 0.
Proof.
move=> free /submxP [a ea] /submxP [b eb] /submxP [c ec] /submxP [d ed].
have : row_mx (row_mx a b) (row_mx c d) *m four_planes A B C D = 0.
  rewrite /four_planes !mul_row_col !mul_mx_row !mulmx0 !mulmxN !add_row_mx -ea -eb -ec -ed.
  by rewrite !(addr0, add0r) !subrr !row_mx0.
by move/eqP; rewrite mulmx_free_eq0 // !row_mx_eq0 => /andP [/andP [/eqP a0 _] _]; rewrite ea a0 mul0mx.
Qed.

Lemma plane_through A B V : \rank (A :&: B)%MS = 2%N -> row_free V ->
  exists2 w : 'rV[F]_4, w != 0 & [/\ (w <= A)%MS, (w <= B)%MS & (w <= V)%MS].
Proof.
move=> r2 fV; pose W := ((A :&: B) :&: V)%MS.
have W0 : W != 0.
  rewrite -mxrank_eq0; have := mxrank_sum_cap (A :&: B)%MS V; rewrite r2 (eqP fV) -/W.
  by have := rank_leq_col (A :&: B + V)%MS; move: (\rank _) (\rank W) => x y; lia.
exists (nz_row W); first by rewrite nz_row_eq0.
have := nz_row_sub W; rewrite !sub_capmx => /andP [/andP [-> ->] ->].
by split.
Qed.

(* what a node between two others says of these *)
Lemma between A B V Qa Qb Qv (H H' : 'M_4) x y x' y' (w : 'rV_4) a b : y != 0 -> x' != 0 -> w = a *m A -> w = b *m B -> (w <= V)%MS ->
  Qa = x *: (A *m H) -> Qv = y *: (V *m H) -> Qv = y' *: (V *m H') -> Qb = x' *: (B *m H') ->
  a *m Qa = (x * y' / (y * x')) *: (b *m Qb).
Proof.
move=> y0 x0 ea eb /submxP [c ec] -> e1 e2 ->; rewrite -!scalemxAr !mulmxA -ea -eb ec -!mulmxA scalerA.
have -> : V *m H = (y^-1 * y') *: (V *m H') by rewrite -scalerA -e2 e1 scalerA mulVf // scale1r.
rewrite -scalemxAr scalerA; congr (_ *: _).
by field; rewrite y0 x0.
Qed.

Theorem rule_5 A B V1 V2 V3 Qa Qb :
  row_free A -> row_free B -> row_free V1 -> row_free V2 -> row_free V3 -> row_free Qb -> fund A B != 0 ->
  row_free (independence A B V1) ->
  row_free (four_planes A B V1 V2) -> row_free (four_planes A B V1 V3) -> row_free (four_planes A B V2 V3) ->
  (forall V, V \in [:: V1; V2; V3] -> exists Qv : 'M[F]_(3, 4), exists2 H : 'M[F]_4, H \in unitmx & exists2 H' : 'M[F]_4, H' \in unitmx &
     exists x y x' y' : F, [/\ x != 0, y != 0, x' != 0 & y' != 0] /\ [/\ Qa = x *: (A *m H), Qv = y *: (V *m H), Qv = y' *: (V *m H') & Qb = x' *: (B *m H')]) ->
  exists2 H : 'M[F]_4, H \in unitmx & Qa = A *m H /\ exists2 s, s != 0 & Qb = s *: (B *m H).
Proof.
move=> fA fB f1 f2 f3 fQ nz ind p12 p13 p23 mid.
have cap2 : \rank (A :&: B)%MS = 2%N.
  have := mxrank_sum_cap A B; rewrite (distinct nz) (eqP fA) (eqP fB); move: (\rank _) => z; lia.
have [w1 n1 [a1 b1 v1]] := plane_through cap2 f1.
have [w2 n2 [a2 b2 v2]] := plane_through cap2 f2.
have [w3 n3 [a3 b3 v3]] := plane_through cap2 f3.
have indep c d : c *: w2 + d *: w3 = 0 -> c = 0 /\ d = 0.
  move=> e; have d0 : d = 0.
    apply/eqP; apply: contraT => d0; case/negP: n3; apply/eqP; apply: (no_plane p23) => //.
    have -> : w3 = (- (d^-1 * c)) *: w2; last exact: scalemx_sub.
    have -> : w3 = d^-1 *: (d *: w3) by rewrite scalerA mulVf // scale1r.
    by have /eqP := e; rewrite addrC addr_eq0 => /eqP ->; rewrite scalerN scalerA scaleNr.
  split=> //; move: e; rewrite d0 scale0r addr0 => /eqP; rewrite scaler_eq0 (negbTE n2) orbF => /eqP.
  by [].
have span (w : 'rV_4) : (w <= A)%MS -> (w <= B)%MS -> exists c d, w = c *: w2 + d *: w3.
  move=> wA wB; have r : row_free (col_mx w2 w3).
    rewrite -kermx_eq0; apply/rowV0P=> u /sub_kermxP; rewrite -[u]hsubmxK mul_row_col.
    rewrite [lsubmx u]mx11_scalar [rsubmx u]mx11_scalar !mul_scalar_mx => /indep [-> ->].
    by rewrite !raddf0 row_mx0.
  have sub : (col_mx w2 w3 <= A :&: B)%MS by rewrite sub_capmx !col_mx_sub a2 a3 b2 b3.
  have : (w <= col_mx w2 w3)%MS.
    apply: submx_trans (_ : (A :&: B <= _)%MS); first by rewrite sub_capmx wA.
    by rewrite -(geq_leqif (mxrank_leqif_sup sub)) cap2 (eqP r).
  case/submxP=> u ->; exists (lsubmx u 0 0), (rsubmx u 0 0); rewrite -{1}[u]hsubmxK mul_row_col.
  by rewrite {1}[lsubmx u]mx11_scalar {1}[rsubmx u]mx11_scalar !mul_scalar_mx.
have [p [q w1E]] := span w1 a1 b1.
have p0 : p != 0.
  apply: contra n1 => /eqP p0; apply/eqP; apply: (no_plane p13) => //.
  by rewrite w1E p0 scale0r add0r scalemx_sub.
have q0 : q != 0.
  apply: contra n1 => /eqP q0; apply/eqP; apply: (no_plane p12) => //.
  by rewrite w1E q0 scale0r addr0 scalemx_sub.
move: a1 a2 a3 b1 b2 b3 => /submxP [a1 ea1] /submxP [a2 ea2] /submxP [a3 ea3] /submxP [b1 eb1] /submxP [b2 eb2] /submxP [b3 eb3].
have scale V (w : 'rV_4) a b : V \in [:: V1; V2; V3] -> (w <= V)%MS -> w = a *m A -> w = b *m B ->
    exists2 s : F, s != 0 & a *m Qa = s *: (b *m Qb).
  move=> /mid [Qv [H _ [H' _ [x [y [x' [y' [[x0 y0 x'0 y'0] [eA eV eV' eB]]]]]]]]] wV wA wB.
  exists (x * y' / (y * x')); first by rewrite !mulf_neq0 // invr_eq0 mulf_neq0.
  exact: (between y0 x'0 wA wB wV eA eV eV' eB).
have [s1 _ e1] := scale V1 w1 a1 b1 (mem_head _ _) v1 ea1 eb1.
have [s2 s20 e2] : exists2 s : F, s != 0 & a2 *m Qa = s *: (b2 *m Qb) by apply: (scale V2 w2) => //; rewrite !inE eqxx orbT.
have [s3 _ e3] : exists2 s : F, s != 0 & a3 *m Qa = s *: (b3 *m Qb) by apply: (scale V3 w3) => //; rewrite !inE eqxx !orbT.
have a1E : a1 = p *: a2 + q *: a3.
  by apply: (row_free_inj fA); rewrite mulmxDl -!scalemxAl -ea1 -ea2 -ea3.
have b1E : b1 = p *: b2 + q *: b3.
  by apply: (row_free_inj fB); rewrite mulmxDl -!scalemxAl -eb1 -eb2 -eb3.
have sE : (p * (s1 - s2)) *: b2 + (q * (s1 - s3)) *: b3 = 0.
  apply: (row_free_inj fQ); rewrite mul0mx mulmxDl -!scalemxAl.
  move: e1; rewrite a1E b1E !mulmxDl -!scalemxAl e2 e3 => /eqP; rewrite -subr_eq0 => /eqP e.
  apply/rowP=> k; have := congr1 (fun z : 'rV_4 => z 0 k) e; rewrite !mxE.
  move: ((b2 *m Qb) 0 k) ((b3 *m Qb) 0 k) => y z h; apply/eqP; rewrite -oppr_eq0 -[X in _ == X]h; apply/eqP; ring.
have [z2 z3] : p * (s1 - s2) = 0 /\ q * (s1 - s3) = 0.
  by apply: indep; rewrite eb2 eb3 !scalemxAl -mulmxDl sE mul0mx.
have {z2} s12 : s1 = s2 by move/eqP: z2; rewrite mulf_eq0 (negbTE p0) subr_eq0 => /eqP.
have {z3} s13 : s1 = s3 by move/eqP: z3; rewrite mulf_eq0 (negbTE q0) subr_eq0 => /eqP.
pose M := col_mx A B; pose N := col_mx Qa (s2 *: Qb).
have kN (m : nat) (u : 'M_(m, 3 + 3)) : u *m M = 0 -> u *m N = 0.
  move=> uM; apply/row_matrixP=> i; rewrite row_mul row0; have {uM} : row i u *m M = 0 by rewrite -row_mul uM row0.
  rewrite -[row i u]hsubmxK /M /N !mul_row_col; move: (lsubmx _) (rsubmx _) => x y /eqP; rewrite addr_eq0 => /eqP xy.
  have [c [d e]] : exists c d, x *m A = c *: w2 + d *: w3.
    by apply: span; [exact: submxMl | rewrite xy -mulNmx submxMl].
  have -> : x = c *: a2 + d *: a3 by apply: (row_free_inj fA); rewrite e mulmxDl -!scalemxAl -ea2 -ea3.
  have -> : y = - (c *: b2 + d *: b3).
    by apply: (row_free_inj fB); rewrite mulNmx mulmxDl -!scalemxAl -eb2 -eb3 -e xy opprK.
  rewrite mulNmx !mulmxDl -!scalemxAl e2 e3 -s13 s12 -!scalemxAr !scalerA [c * _]mulrC [d * _]mulrC.
  by rewrite subrr.
pose H := pinvmx M *m N.
have MH : M *m H = N.
  apply/eqP; rewrite -subr_eq0; apply/eqP; have : (M *m pinvmx M - 1%:M) *m N = 0.
    by apply: kN; rewrite mulmxBl mul1mx mulmxKpV ?subrr.
  by rewrite mulmxBl mul1mx /H mulmxA.
have [AH BH] : A *m H = Qa /\ B *m H = s2 *: Qb by have := MH; rewrite /M mul_col_mx => /eq_col_mx.
have [Qv [H1 u1 [H1' u1' [x [y [x' [y' [[x0 y0 x'0 y'0] [eA eV eV' eB]]]]]]]]] := mid V1 (mem_head _ _).
have HH : 1 *: H = x *: H1.
  apply: (three_bodies (A := A) (C := B) (V := V1) (H1 := H) (H2 := H1) (H3 := H1') (s1 := 1) (s2 := x) (t1 := 1) (t3 := s2 * x') (w2 := y) (w3 := y')) => //; rewrite ?oner_neq0 // ?scale1r.
  - by rewrite AH.
  - by rewrite BH eB scalerA.
  - by rewrite -eV.
exists H; first by rewrite -[H]scale1r HH unitmxZ // unitfE.
split; first by rewrite AH.
exists s2^-1; first by rewrite invr_eq0.
by rewrite BH scalerA mulVf // scale1r.
Qed.
End Biclique.

(* Cameras of rank 3 whose centres are different, and no three of them on a line *)
Definition no_three_on_a_line (F : fieldType) n (P : cameras F n) : Prop :=
  [/\ forall v, row_free (cam P v), forall i j, i != j -> (1 < \rank (fund (cam P i) (cam P j)))%N &
      forall i j k, i != j -> i != k -> j != k -> row_free (independence (cam P i) (cam P j) (cam P k))].

Section Nice.
Variable n : nat.

Lemma poly_cam v : polynomial_matrix (fun R (P : cameras R n) => cam P v).
Proof. by move=> h k; exact: poly_camera. Qed.

Lemma poly_fund i j : polynomial_matrix (fun R (P : cameras R n) => fund (cam P i) (cam P j)).
Proof.
move=> h k; have d : is_polynomial (fun R (P : cameras R n) => \det (col_mx (row' k (cam P i)) (row' h (cam P j)) : 'M_4)).
  apply: poly_det => r c; case: (@split_ordP 2 2 r) => s ->.
    apply: poly_eq (poly_camera i (lift k s) c) => R P.
    by rewrite -[RHS]/(col_mx (row' k (cam P i)) (row' h (cam P j)) (lshift 2 s) c) col_mxEu [RHS]mxE.
  apply: poly_eq (poly_camera j (lift h s) c) => R P.
  by rewrite -[RHS]/(col_mx (row' k (cam P i)) (row' h (cam P j)) (rshift 2 s) c) col_mxEd [RHS]mxE.
apply: poly_eq (poly_mul (poly_number n (3 * 4) ((-1) ^+ (h + k))) d) => R P.
by rewrite rmorphX rmorphN rmorph1 [RHS]mxE.
Qed.

Lemma poly_independence i j k : polynomial_matrix (fun R (P : cameras R n) => independence (cam P i) (cam P j) (cam P k)).
Proof.
have zero : is_polynomial (fun R (P : cameras R n) => 0) by apply: poly_eq (poly_number n (3 * 4) 0) => R P.
move=> r c; case: (@split_ordP 4 4 r) => s ->; case: (@split_ordP (3 + 3) 3 c) => t ->; try (case: (@split_ordP 3 3 t) => u ->).
- by apply: poly_eq (poly_camera i u s) => R P; rewrite /independence col_mxEu !row_mxEl [RHS]mxE.
- by apply: poly_eq zero => R P; rewrite /independence col_mxEu row_mxEl row_mxEr mxE.
- by apply: poly_eq (poly_camera k t s) => R P; rewrite /independence col_mxEu row_mxEr [RHS]mxE.
- by apply: poly_eq zero => R P; rewrite /independence col_mxEd row_mxEl row_mxEl mxE.
- by apply: poly_eq (poly_camera j u s) => R P; rewrite /independence col_mxEd row_mxEl row_mxEr [RHS]mxE.
- by apply: poly_eq (poly_camera k t s) => R P; rewrite /independence col_mxEd row_mxEr [RHS]mxE.
Qed.
End Nice.

Section Attained.
Variable n : nat.
Implicit Types i j k v : 'I_n.

(* centres 0, e_1, e_2 at i, j, k *)
Definition spread (j k : nat) : nat -> nat -> rat :=
  fun (v h : nat) => ((v == j) && (h == 0%N) || (v == k) && (h == 1%N))%:R.

Lemma normal_free (c : nat -> nat -> rat) v : row_free (cam (normal n c) v : 'M[rat]_(3, 4)).
Proof.
rewrite cam_normal; apply/row_freeP; exists (\matrix_(r < 4, d < 3) (r == d :> nat)%:R).
apply/matrixP=> a b; rewrite !mxE !big_ord_recl big_ord0 !mxE /normal_entry.
by case: a b => [[|[|[|//]]] ?] [[|[|[|//]]] ?]; rewrite /= ?(mulr0, mul0r, mulr1, addr0, add0r).
Qed.

Lemma spread_fund i j : i != j ->
  (1 < \rank (fund (cam (normal n (spread j j)) i) (cam (normal n (spread j j)) j) : 'M[rat]_3))%N.
Proof.
move=> ij; rewrite !cam_normal fund_normal; set G : 'M[rat]_3 := mx 3 3 _.
pose U : 'M[rat]_(2, 3) := \matrix_(r, c) (r.+1 == c)%:R.
pose V : 'M[rat]_(3, 2) := \matrix_(r, c) (((r == 1%N :> nat) && (c == 1%N :> nat))%:R - ((r == 2%N :> nat) && (c == 0%N :> nat))%:R).
have UGV : U *m G *m V = 1%:M.
  apply/matrixP=> a b; rewrite !mxE !big_ord_recl !big_ord0 !mxE !big_ord_recl !big_ord0 !mxE /F_entry /diff /spread.
  rewrite !val_eqE (negbTE ij) eqxx.
  by case: a b => [[|[|//]] ?] [[|[|//]] ?].
have := leq_trans (mxrankM_maxl (U *m G) V) (mxrankM_maxr U G).
by rewrite UGV mxrank1.
Qed.

Lemma spread_independent i j k : i != j -> i != k -> j != k ->
  row_free (independence (cam (normal n (spread j k)) i) (cam (normal n (spread j k)) j) (cam (normal n (spread j k)) k) : 'M[rat]_(_, _)).
Proof.
move=> ij ik jk; rewrite -kermx_eq0; apply/rowV0P=> u /sub_kermxP.
rewrite -[u]hsubmxK; move: (lsubmx u) (rsubmx u) => x y {u}.
rewrite mul_row_col !mul_mx_row !mulmx0 add_row_mx add_row_mx addr0 add0r -mulmxDl => /eqP.
rewrite !row_mx_eq0 !cam_normal => /andP [/andP [/eqP/rowP ex /eqP/rowP ey] /eqP/rowP ez].
have [ji ki kj] : [/\ j == i = false, k == i = false & k == j = false].
  by rewrite ![_ == i]eq_sym [k == j]eq_sym !(negbTE ij, negbTE ik, negbTE jk).
have := ez (@Ordinal 3 2 isT); have := ez (@Ordinal 3 1 isT); have := ez (@Ordinal 3 0 isT).
have := ey (@Ordinal 3 2 isT); have := ey (@Ordinal 3 1 isT); have := ey (@Ordinal 3 0 isT).
have := ex (@Ordinal 3 2 isT); have := ex (@Ordinal 3 1 isT); have := ex (@Ordinal 3 0 isT).
rewrite !mxE !big_ord_recl !big_ord0 !mxE /normal_entry /spread /= !val_eqE !eqxx !(negbTE ij, negbTE ik, negbTE jk, ji, ki, kj) /=.
rewrite !(mulr0n, mulr1n, oppr0, mulr0, mulr1, addr0, add0r, mulrN1) => x0 x1 x2 /eqP y03 y1 y2.
have all4 (z : 'rV[rat]_4) : z 0 ord0 = 0 -> z 0 (lift ord0 ord0) = 0 -> z 0 (lift ord0 (lift ord0 ord0)) = 0 ->
    z 0 (lift ord0 (lift ord0 (lift ord0 ord0))) = 0 -> z = 0.
  move=> z0 z1 z2 z3; apply/rowP=> a; rewrite [RHS]mxE.
  by case: a => [[|[|[|[|//]]]] p]; [rewrite -[RHS]z0 | rewrite -[RHS]z1 | rewrite -[RHS]z2 | rewrite -[RHS]z3];
    congr (z 0 _); apply: val_inj.
rewrite x0 x1 x2 y1 y2 !add0r => y0; move: y03; rewrite y0 add0r oppr_eq0 => /eqP y3.
rewrite y3 addr0 => /eqP; rewrite oppr_eq0 => /eqP x3 _.
by rewrite (all4 x) // (all4 y) // row_mx0.
Qed.

(* Generic cameras are so. *)
Theorem generic_cameras : @generically n (3 * 4) (fun F P => no_three_on_a_line P).
Proof.
have rows : @generically n (3 * 4) (fun F P => forall v, v \in enum 'I_n -> (3 <= \rank (cam P v))%N).
  apply: (@generically_all n (3 * 4) _ _ (fun v F P => (3 <= \rank (cam P v))%N)) => v _.
  apply: (rank_generically (P0 := normal n (fun _ _ => 0)) (@poly_cam n v)).
  by rewrite (eqP (normal_free _ v)).
have funds : @generically n (3 * 4) (fun F P => forall e, e \in enum {: 'I_n * 'I_n} -> e.1 != e.2 -> (1 < \rank (fund (cam P e.1) (cam P e.2)))%N).
  apply: (@generically_all n (3 * 4) _ _ (fun e F P => e.1 != e.2 -> (1 < \rank (fund (cam P e.1) (cam P e.2)))%N)) => -[i j] _ /=.
  case: (eqVneq i j) => [_|ij]; first exact: generically_true.
  apply: generically_impl (rank_generically (@poly_fund n i j) (spread_fund ij)) => F P h _.
  exact: h.
have lines : @generically n (3 * 4) (fun F P => forall e, e \in enum {: 'I_n * 'I_n * 'I_n} ->
    e.1.1 != e.1.2 -> e.1.1 != e.2 -> e.1.2 != e.2 -> (8 <= \rank (independence (cam P e.1.1) (cam P e.1.2) (cam P e.2)))%N).
  apply: (@generically_all n (3 * 4) _ _ (fun e F P => e.1.1 != e.1.2 -> e.1.1 != e.2 -> e.1.2 != e.2 ->
    (8 <= \rank (independence (cam P e.1.1) (cam P e.1.2) (cam P e.2)))%N)) => -[[i j] k] _ /=.
  case: (eqVneq i j) => [_|ij]; first exact: generically_true.
  case: (eqVneq i k) => [_|ik]; first exact: generically_true.
  case: (eqVneq j k) => [_|jk]; first exact: generically_true.
  have := spread_independent ij ik jk; rewrite /row_free => /eqP r8.
  apply: generically_impl (rank_generically (@poly_independence n i j k) (r := 8) (P0 := normal n (spread j k)) _) => [F P h _ _ _|].
    exact: h.
  by rewrite r8.
apply: generically_impl (generically_and rows (generically_and funds lines)) => F P [r [f l]]; split.
- by move=> v; have := r v (mem_enum _ _); rewrite /row_free eqn_leq rank_leq_row.
- by move=> i j; exact: (f (i, j) (mem_enum _ _)).
- by move=> i j k ij ik jk; rewrite /row_free eqn_leq rank_leq_row; exact: (l (i, j, k) (mem_enum _ _)).
Qed.
End Attained.
