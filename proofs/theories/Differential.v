(* Lemma 1.2, and what it makes of the kernel of J_P: the motions along which no fundamental matrix changes but by a
   factor. It is the algebraic half of the proof of Theorem 1.3; that the dimension of a generic fibre is that of this
   kernel is not formal. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Line.
Variable F : fieldType.
Hypothesis two0 : 2%:R != 0 :> F.

(* Skew-symmetric matrices whose rows lie in the span of two are multiples of one. *)
Definition turn : 'M[F]_2 := \matrix_(i, j) (if i == j then 0 else if i == ord0 then 1 else - 1).
Lemma skew_two (s : 'M[F]_2) : s^T = - s -> s = s ord0 (lift ord0 ord0) *: turn.
Proof.
move=> sk; have e i j : s j i = - s i j by have := congr1 (fun m : 'M_2 => m i j) sk; rewrite !mxE.
have diag i : s i i = 0.
  have := e i i; move/eqP; rewrite -addr_eq0 -mulr2n -mulr_natl mulf_eq0 (negbTE two0) => /eqP.
  by [].
apply/matrixP=> i j; rewrite !mxE; case: (eqVneq i j) => [->|ne]; first by rewrite mulr0 diag.
move: i j ne; case=> [[|[|//]] hi]; case=> [[|[|//]] hj] // _.
  by rewrite mulr1; congr (s _ _); apply: val_inj.
by rewrite mulrN1 -e; congr (s _ _); apply: val_inj.
Qed.

Lemma skew_span k r (U : 'M[F]_(r, k)) (S : 'M[F]_k) (r2 : r = 2%N) : S^T = - S -> (S <= U)%MS ->
  exists x : F, S = x *: (U^T *m castmx (esym r2, esym r2) turn *m U).
Proof.
subst r => sk SU; rewrite castmx_id.
have [V right] : exists V, S *m V *m U = S by exists (pinvmx U); exact: mulmxKpV.
have left : (V *m U)^T *m S = S.
  by rewrite -[S in LHS]opprK -sk mulmxN -trmx_mul mulmxA right sk opprK.
pose s := V^T *m S *m V.
have ss : s^T = - s by rewrite /s !trmx_mul trmxK sk mulNmx mulmxN mulmxA.
exists (s ord0 (lift ord0 ord0)); rewrite -[LHS]left -[in LHS]right trmx_mul.
have -> : U^T *m V^T *m (S *m V *m U) = U^T *m s *m U by rewrite /s !mulmxA.
by rewrite {1}(skew_two ss) -scalemxAr -scalemxAl.
Qed.

Lemma without k (A : 'M[F]_(3, 4)) : (row' k A <= A)%MS.
Proof.
apply/row_subP=> i; have -> : row i (row' k A) = row (lift k i) A by apply/rowP=> j; rewrite !mxE.
exact: row_sub.
Qed.

Lemma distinct (A B : 'M[F]_(3, 4)) : fund A B != 0 -> \rank (A + B)%MS = 4%N.
Proof.
move=> nz; apply/eqP; rewrite eqn_leq rank_leq_col /= leqNgt; apply: contra nz => r3; apply/eqP/matrixP=> h k.
rewrite [LHS]mxE [RHS]mxE; pose C : 'M[F]_4 := col_mx (row' k A) (row' h B).
have rC : (\rank C < 4)%N.
  have := col_mx_sub (row' k A) (row' h B) (A + B)%MS.
  rewrite (submx_trans (without k A) (addsmxSl _ _)) (submx_trans (without h B) (addsmxSr _ _)).
  by move/mxrankS => le; apply: leq_ltn_trans r3.
have : C \notin unitmx by rewrite -row_full_unit /row_full neq_ltn rC.
by rewrite unitmxE unitfE negbK => /eqP; rewrite /C => ->; rewrite mulr0.
Qed.

(* Cameras of rank 3 with different centres: a matrix whose S is skew-symmetric is a multiple of F. *)
Theorem lemma_1_2 (A B : 'M[F]_(3, 4)) (M : 'M[F]_3) : row_free A -> row_free B -> fund A B != 0 ->
  let S := B^T *m M *m A in S^T = - S -> exists t : F, M = t *: fund A B.
Proof.
move=> fA fB nz S sk; have sk0 := skew A B; cbv zeta in sk0; set G := fund A B in nz sk0 *.
have [/row_freeP [A' rA] /row_freeP [B' rB]] := (fA, fB).
have recover (N : 'M[F]_3) : B'^T *m (B^T *m N *m A) *m A' = N.
  by rewrite !mulmxA -trmx_mul rB trmx1 mul1mx -mulmxA rA mulmx1.
have inside (N : 'M[F]_3) : (B^T *m N *m A)^T = - (B^T *m N *m A) -> (B^T *m N *m A <= A :&: B)%MS.
  move=> k; rewrite sub_capmx submxMl /= -[X in (X <= _)%MS]opprK -k eqmx_opp.
  by rewrite !trmx_mul trmxK mulmxA submxMl.
have full := distinct nz.
have cap2 : \rank (A :&: B)%MS = 2%N.
  have := mxrank_sum_cap A B; rewrite full (eqP fA) (eqP fB); lia.
have base (N : 'M[F]_3) : (B^T *m N *m A)^T = - (B^T *m N *m A) -> (B^T *m N *m A <= row_base (A :&: B))%MS.
  by move=> k; rewrite eq_row_base (inside N k).
have [x0 e0] := skew_span cap2 sk0 (base _ sk0).
have [x1 e1] := skew_span cap2 sk (base _ sk).
have x0n : x0 != 0.
  by apply: contra nz => /eqP z; rewrite -[G]recover e0 z scale0r mulmx0 mul0mx.
exists (x1 / x0); rewrite -[M]recover -/S e1 -[G]recover e0.
by rewrite -!(scalemxAr, scalemxAl) scalerA divfK.
Qed.
End Line.

(* F along a line: coefficients of t^i in matrices of polynomials, and the derivative of [fund] at A, B along a, b *)
Section Differential.
Variable F : fieldType.
Hypothesis two0 : 2%:R != 0 :> F.
Definition term m n i (M : 'M[{poly F}]_(m, n)) : 'M[F]_(m, n) := \matrix_(r, c) (M r c)`_i.
Definition along m n (A a : 'M[F]_(m, n)) : 'M[{poly F}]_(m, n) := \matrix_(r, c) ((A r c)%:P + (a r c)%:P * 'X).
Definition dfund (A B a b : 'M[F]_(3, 4)) : 'M[F]_3 := term 1 (fund (along A a) (along B b)).

Lemma term0 m n (M : 'M[{poly F}]_(m, n)) : term 0 M = map_mx (horner_eval 0) M.
Proof. by apply/matrixP=> r c; rewrite !mxE /horner_eval horner_coef0. Qed.
Lemma term0_along m n (A a : 'M[F]_(m, n)) : term 0 (along A a) = A.
Proof. by apply/matrixP=> r c; rewrite !mxE coefD coefC coefMX addr0. Qed.
Lemma term1_along m n (A a : 'M[F]_(m, n)) : term 1 (along A a) = a.
Proof. by apply/matrixP=> r c; rewrite !mxE coefD coefC coefMX /= coefC add0r. Qed.
Lemma term_tr m n i (M : 'M[{poly F}]_(m, n)) : term i M^T = (term i M)^T.
Proof. by apply/matrixP=> r c; rewrite !mxE. Qed.
Lemma term_opp m n i (M : 'M[{poly F}]_(m, n)) : term i (- M) = - term i M.
Proof. by apply/matrixP=> r c; rewrite !mxE coefN. Qed.
Lemma term0_mul m n q (M : 'M[{poly F}]_(m, n)) (N : 'M_(n, q)) : term 0 (M *m N) = term 0 M *m term 0 N.
Proof. by rewrite !term0 map_mxM. Qed.
Lemma term1_mul m n q (M : 'M[{poly F}]_(m, n)) (N : 'M_(n, q)) :
  term 1 (M *m N) = term 1 M *m term 0 N + term 0 M *m term 1 N.
Proof.
apply/matrixP=> r c; rewrite !mxE coef_sum -big_split; apply: eq_bigr => j _ /=.
by rewrite !mxE coefM !big_ord_recl big_ord0 addr0 addrC.
Qed.
Lemma term0_fund A B a b : term 0 (fund (along A a) (along B b)) = fund A B.
Proof. by rewrite term0 map_fund -!term0 !term0_along. Qed.

(* the derivative of S + S^T = 0, and the motions that (1.2) allows *)
Theorem differential n (P dP : cameras F n) e :
  let T := (cam P e.2)^T *m dfund (cam P e.1) (cam P e.2) (cam dP e.1) (cam dP e.2) *m cam P e.1 in
  equation P e dP = - (T + T^T).
Proof.
rewrite /equation /dfund; move: (cam P e.1) (cam P e.2) (cam dP e.1) (cam dP e.2) => A B a b.
have sk := skew (along A a) (along B b); cbv zeta in sk.
have := congr1 (term 1) sk; rewrite term_tr term_opp !term1_mul !term0_mul term_tr term_tr !term0_along !term1_along term0_fund.
move: (term 1 _) (fund A B) => D G; set X := b^T *m G *m A; set Y := B^T *m D *m A; set Z := B^T *m G *m a.
have -> : A^T *m G^T *m b = X^T by rewrite /X !trmx_mul trmxK mulmxA.
rewrite mulmxDl -/X -/Y -/Z; move: X Y Z => X Y Z /eqP; rewrite -addr_eq0 => /eqP h /=.
apply/matrixP=> i j; have := congr1 (fun m : 'M_4 => m i j) h; rewrite !mxE.
move: (X i j) (X j i) (Y i j) (Y j i) (Z i j) (Z j i) => x x' y y' z z' h0.
by apply/eqP; rewrite -subr_eq0; apply/eqP; rewrite -[RHS]h0; ring.
Qed.

(* J k = 0 iff dF(k) is a multiple of F on every pair *)
Theorem kernel_of_map n (E : seq ('I_n * 'I_n)) (P : cameras F n) (u : 'rV_(n * (3 * 4))) :
  (forall v, row_free (cam P v)) -> (forall e, e \in E -> fund (cam P e.1) (cam P e.2) != 0) ->
  let k := vec_mx u : cameras F n in
  (u <= kermx (J E P))%MS <-> forall e, e \in E -> exists t : F,
    dfund (cam P e.1) (cam P e.2) (cam k e.1) (cam k e.2) = t *: fund (cam P e.1) (cam P e.2).
Proof.
move=> rows nz k; rewrite J_kerP -/k; split=> [/allP h e eE | h].
  apply: lemma_1_2 => //; first exact: nz.
  have /eqP := h e eE; rewrite differential; set T := _ *m _ *m _ => /eqP.
  by rewrite oppr_eq0 addrC addr_eq0 => /eqP.
apply/allP=> e /h [t dt]; rewrite differential dt -scalemxAr -scalemxAl.
have sk := skew (cam P e.1) (cam P e.2); cbv zeta in sk.
by rewrite linearZ /= sk scalerN addrN oppr0.
Qed.
End Differential.
