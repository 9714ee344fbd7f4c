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
pose X := (s1 *: H1 - s2 *: H2)^T; pose Y := (t1 *: H1 - t3 *: H3)^T; pose Z := (w2 *: H2 - w3 *: H3)^T.
have zero (A : 'M[F]_(3, 4)) (x y : F) (K L : 'M_4) : x *: (A *m K) = y *: (A *m L) -> (x *: K - y *: L)^T *m A^T = 0.
  by move=> xy; rewrite -trmx_mul mulmxBr -!scalemxAr xy subrr trmx0.
have [XA YC ZV] : [/\ X *m (cam P a)^T = 0, Y *m (cam P c)^T = 0 & Z *m (cam P v)^T = 0] by split; exact: zero.
have {zero} := And3 XA YC ZV.
have sum (kap : F) : kap = s1 * w2 * t3 - s2 * t1 * w3 -> kap *: H3^T = (t1 * w2) *: X - (s1 * w2) *: Y + (s2 * t1) *: Z.
  move=> ->; rewrite /X /Y /Z; apply/matrixP=> i j; rewrite !mxE.
  by move: (H1 j i) (H2 j i) (H3 j i) => *; ring.
have H12 : X = 0 -> s1 *: H1 = s2 *: H2.
  by move/eqP; rewrite /X trmx_eq0 subr_eq0 => /eqP.
move: X Y Z sum H12 {XA YC ZV} => X Y Z sum H12 [XA YC ZV].
have le1 (A : 'M[F]_(3, 4)) (K : 'M_4) z : row_free A -> K *m A^T = 0 -> (\rank (z *: K) <= 1)%N.
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
have {}H12 : s1 *: H1 = s2 *: H2.
  by apply: H12; apply/eqP; move/eqP: X0; rewrite scaler_eq0 mulf_eq0 (negbTE t10) (negbTE w20).
exists H1 => // x; rewrite inE => /predU1P [->|/h1 //].
exists (w2 / s2 * s1); first by rewrite !mulf_neq0 // invr_eq0.
by rewrite k2 -scalerA (scalemxAr s1) H12 -scalemxAr scalerA divfK.
Qed.
End Same.

(* Cameras of rank 3 whose centres are different, and no three of them on a line *)
Definition no_three_on_a_line (F : fieldType) n (P : cameras F n) : Prop :=
  [/\ forall v, row_free (cam P v), forall i j, i != j -> (1 < \rank (fund (cam P i) (cam P j)))%N &
      forall i j k, i != j -> i != k -> j != k -> row_free (independence (cam P i) (cam P j) (cam P k))].

Section Nice.
Variable n : nat.

Lemma poly_cam v : polynomial_matrix (fun R (P : cameras R n) => cam P v).
Proof. by move=> h k; exact: poly_entry. Qed.

Lemma poly_fund i j : polynomial_matrix (fun R (P : cameras R n) => fund (cam P i) (cam P j)).
Proof.
move=> h k; have d : is_polynomial (fun R (P : cameras R n) => \det (col_mx (row' k (cam P i)) (row' h (cam P j)) : 'M_4)).
  apply: poly_det => r c; case: (@split_ordP 2 2 r) => s ->.
    apply: poly_eq (poly_entry i (lift k s) c) => R P.
    by rewrite -[RHS]/(col_mx (row' k (cam P i)) (row' h (cam P j)) (lshift 2 s) c) col_mxEu [RHS]mxE.
  apply: poly_eq (poly_entry j (lift h s) c) => R P.
  by rewrite -[RHS]/(col_mx (row' k (cam P i)) (row' h (cam P j)) (rshift 2 s) c) col_mxEd [RHS]mxE.
apply: poly_eq (poly_mul (poly_number n ((-1) ^+ (h + k))) d) => R P.
by rewrite rmorphX rmorphN rmorph1 [RHS]mxE.
Qed.

Lemma poly_independence i j k : polynomial_matrix (fun R (P : cameras R n) => independence (cam P i) (cam P j) (cam P k)).
Proof.
have zero : is_polynomial (fun R (P : cameras R n) => 0) by apply: poly_eq (poly_number n 0) => R P.
move=> r c; case: (@split_ordP 4 4 r) => s ->; case: (@split_ordP (3 + 3) 3 c) => t ->; try (case: (@split_ordP 3 3 t) => u ->).
- by apply: poly_eq (poly_entry i u s) => R P; rewrite /independence col_mxEu !row_mxEl [RHS]mxE.
- by apply: poly_eq zero => R P; rewrite /independence col_mxEu row_mxEl row_mxEr mxE.
- by apply: poly_eq (poly_entry k t s) => R P; rewrite /independence col_mxEu row_mxEr [RHS]mxE.
- by apply: poly_eq zero => R P; rewrite /independence col_mxEd row_mxEl row_mxEl mxE.
- by apply: poly_eq (poly_entry j u s) => R P; rewrite /independence col_mxEd row_mxEl row_mxEr [RHS]mxE.
- by apply: poly_eq (poly_entry k t s) => R P; rewrite /independence col_mxEd row_mxEr [RHS]mxE.
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
Theorem generic_cameras : @generically n (fun F P => no_three_on_a_line P).
Proof.
have rows : @generically n (fun F P => forall v, v \in enum 'I_n -> (3 <= \rank (cam P v))%N).
  apply: (@generically_all n _ _ (fun v F P => (3 <= \rank (cam P v))%N)) => v _.
  apply: (rank_generically (P0 := normal n (fun _ _ => 0)) (@poly_cam n v)).
  by rewrite (eqP (normal_free _ v)).
have funds : @generically n (fun F P => forall e, e \in enum {: 'I_n * 'I_n} -> e.1 != e.2 -> (1 < \rank (fund (cam P e.1) (cam P e.2)))%N).
  apply: (@generically_all n _ _ (fun e F P => e.1 != e.2 -> (1 < \rank (fund (cam P e.1) (cam P e.2)))%N)) => -[i j] _ /=.
  case: (eqVneq i j) => [_|ij]; first exact: generically_true.
  apply: generically_impl (rank_generically (@poly_fund n i j) (spread_fund ij)) => F P h _.
  exact: h.
have lines : @generically n (fun F P => forall e, e \in enum {: 'I_n * 'I_n * 'I_n} ->
    e.1.1 != e.1.2 -> e.1.1 != e.2 -> e.1.2 != e.2 -> (8 <= \rank (independence (cam P e.1.1) (cam P e.1.2) (cam P e.2)))%N).
  apply: (@generically_all n _ _ (fun e F P => e.1.1 != e.1.2 -> e.1.1 != e.2 -> e.1.2 != e.2 ->
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
