(* Section 1: J_P is linear, its kernel is (1.2), and the trivial motions of Lemma 1.1 are in it. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From Viewcert Require Import Statement Skew.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Linear.
Variables (R : comRingType) (n : nat).
Implicit Types (P dP U V : cameras R n) (E : seq ('I_n * 'I_n)).

Lemma mxvecP m p a (U V : 'M[R]_(m, p)) : mxvec (a *: U + V) = a *: mxvec U + mxvec V.
Proof. by rewrite linearP. Qed.

Lemma camP a U V v : cam (a *: U + V) v = a *: cam U v + cam V v.
Proof. by rewrite /cam !linearP. Qed.

Lemma equation_is_linear P e : linear (equation P e).
Proof.
move=> a U V; rewrite /equation !camP !mulmxDr -!scalemxAr.
set A := _ *m cam U _; set B := _ *m cam V _; set C := _ *m cam U _; set D := _ *m cam V _.
rewrite [a *: A + B + _]addrACA -scalerDr; set p := A + C; set q := B + D.
by rewrite [(_ + q)^T]linearP /= addrACA -scalerDr.
Qed.
Canonical equation_linear P e := Linear (@equation_is_linear P e).

Definition Jfun E P dP := \matrix_(k < size E) mxvec (equation P (tnth (in_tuple E) k) dP).
Lemma Jfun_is_linear E P : linear (Jfun E P).
Proof.
move=> a U V; apply/row_matrixP=> i; rewrite linearP /= !rowK.
by rewrite !linearP.
Qed.
Canonical Jfun_linear E P := Linear (@Jfun_is_linear E P).

Lemma J_lin E P : J E P = lin_mx (Jfun E P). Proof. by []. Qed.

Lemma J_ker E P u : (u *m J E P == 0) = all (fun e => equation P e (vec_mx u) == 0) E.
Proof.
rewrite J_lin mul_rV_lin mxvec_eq0; apply/eqP/allP => [h e eE | h].
  have k : (index e E < size E)%N by rewrite index_mem.
  have ek : tnth (in_tuple E) (Ordinal k) = e by rewrite (tnth_nth e) /= nth_index.
  have := congr1 (row (Ordinal k)) h; rewrite rowK ek row0 => /eqP.
  by rewrite mxvec_eq0.
apply/row_matrixP=> k; rewrite rowK row0 (eqP (h _ _)) ?linear0 //.
exact: mem_tnth.
Qed.

(* Lemma 1.1: dP_v = P_v X + mu_v P_v *)
Lemma equation_trivial P dP e X a b :
  cam dP e.1 = cam P e.1 *m X + a *: cam P e.1 ->
  cam dP e.2 = cam P e.2 *m X + b *: cam P e.2 -> equation P e dP = 0.
Proof.
rewrite /equation => -> ->; set A := cam P e.1; set B := cam P e.2; set F := fund A B.
have sk := skew A B; rewrite /= -/F in sk; set S := B^T *m F *m A in sk.
have tr : A^T *m F^T *m B = - S by rewrite -sk /S !trmx_mul trmxK mulmxA.
rewrite !mulmxDr -!scalemxAr !mulmxA -/S tr mulNmx scalerN.
rewrite addrACA subrr add0r -scalerBl linearZ /= sk scalerN.
by rewrite subrr.
Qed.

Definition trivial_fun P (u : 'rV[R]_(4 * 4 + n)) : 'rV[R]_(n * (3 * 4)) :=
  mxvec (\matrix_v mxvec (cam P v *m vec_mx (lsubmx u) + rsubmx u 0 v *: cam P v)).
Lemma trivial_is_linear P : linear (trivial_fun P).
Proof.
move=> a u v; rewrite /trivial_fun -mxvecP; congr mxvec; apply/row_matrixP=> i.
rewrite [RHS]linearP /= !rowK -mxvecP; congr mxvec.
have -> : lsubmx (a *: u + v) = a *: lsubmx u + lsubmx v by rewrite linearP.
have -> : rsubmx (a *: u + v) = a *: rsubmx u + rsubmx v by rewrite linearP.
have -> : vec_mx (a *: lsubmx u + lsubmx v) = a *: vec_mx (lsubmx u) + vec_mx (lsubmx v).
  by rewrite linearP.
move: (rsubmx u) (rsubmx v) => x y; rewrite mulmxDr -scalemxAr.
have -> : (a *: x + y) 0 i = a * x 0 i + y 0 i by rewrite !mxE.
by rewrite scalerDl -scalerA addrACA -scalerDr.
Qed.
Canonical trivial_linear P := Linear (@trivial_is_linear P).

(* the matrix of (X, mu) |-> (P_v X + mu_v P_v)_v *)
Definition T P := lin1_mx (trivial_fun P).

Lemma T_J E P : T P *m J E P = 0.
Proof.
apply/row_matrixP=> i; rewrite row_mul row0; apply/eqP.
rewrite J_ker; apply/allP=> e _; rewrite rowE mul_rV_lin1 /= mxvecK.
set u := delta_mx _ _; apply/eqP.
by apply: (@equation_trivial _ _ _ (vec_mx (lsubmx u)) (rsubmx u 0 e.1) (rsubmx u 0 e.2));
  rewrite /cam rowK mxvecK.
Qed.

Lemma equation_swap P dP (i j : 'I_n) : equation P (j, i) dP = equation P (i, j) dP.
Proof. by rewrite /equation /= fund_swap trmxK; congr (_ + _); rewrite addrC. Qed.
End Linear.

(* J_P and the trivial motions are made of polynomials: they commute with ring morphisms *)
Section Morphism.
Variables (R S : comRingType) (f : {rmorphism R -> S}) (n : nat).
Local Notation "A ^f" := (map_mx f A).

Lemma map_cam (P : cameras R n) v : (cam P v)^f = cam P^f v.
Proof. by rewrite /cam map_vec_mx map_row. Qed.

Lemma map_fund A B : (fund A B)^f = fund A^f B^f.
Proof.
apply/matrixP=> h k; rewrite !mxE rmorphM rmorphX rmorphN rmorph1 -det_map_mx.
congr (_ * \det _); apply/matrixP=> r c; rewrite !mxE.
by case: (split _) => s; rewrite !mxE.
Qed.

Lemma map_equation (P dP : cameras R n) e : (equation P e dP)^f = equation P^f e dP^f.
Proof. by rewrite /equation -!map_cam -map_fund !(map_mxD, map_mxM, =^~ map_trmx). Qed.

Lemma map_J E (P : cameras R n) : (J E P)^f = J E P^f.
Proof.
rewrite !J_lin; apply: map_lin_mx => A; apply/row_matrixP=> k.
by rewrite -map_row !rowK map_mxvec map_equation.
Qed.

Lemma map_T (P : cameras R n) : (T P)^f = T P^f.
Proof.
apply: map_lin1_mx => u; rewrite /trivial_fun map_mxvec; congr mxvec; apply/row_matrixP=> k.
rewrite -map_row !rowK map_mxvec -!map_cam; move: (cam P k) => A.
rewrite map_mxD map_mxM map_mxZ map_vec_mx map_lsubmx.
by congr (mxvec (_ + _ *: _)); rewrite -map_rsubmx [RHS]mxE.
Qed.
End Morphism.

(* Ranks of J by kernels *)
Section Ranks.
Variables (F : fieldType) (n : nat).
Implicit Types (E : seq ('I_n * 'I_n)) (P : cameras F n).

Lemma rank_by_ker m p q (A : 'M[F]_(m, p)) (B : 'M[F]_(m, q)) :
  (kermx A <= kermx B)%MS -> (\rank B <= \rank A)%N.
Proof. by move/mxrankS; rewrite !mxrank_ker; have := rank_leq_row A; have := rank_leq_row B; lia. Qed.

Lemma J_kerP E P (u : 'rV_(n * (3 * 4))) :
  (u <= kermx (J E P))%MS = all (fun e => equation P e (vec_mx u) == 0) E.
Proof. by rewrite -J_ker; apply/sub_kermxP/eqP. Qed.

Lemma ker_mono E1 E2 P : {subset E1 <= E2} -> (kermx (J E2 P) <= kermx (J E1 P))%MS.
Proof. by move=> sub; apply/rV_subP=> u; rewrite !J_kerP => /allP h; apply/allP=> e /sub/h. Qed.

Lemma J_mono E1 E2 P : {subset E1 <= E2} -> (\rank (J E1 P) <= \rank (J E2 P))%N.
Proof. by move=> sub; apply: rank_by_ker; apply: ker_mono. Qed.

Lemma J_nil P : \rank (J [::] P) = 0%N.
Proof. by apply/eqP; rewrite mxrank_eq0; apply/eqP/matrixP=> i [j []]. Qed.

(* cameras s_0, .., s_(k-1) of the n, and pairs of their positions *)
Variables (k : nat) (s : 'I_k -> 'I_n).
Definition moved (E : seq ('I_k * 'I_k)) := [seq (s e.1, s e.2) | e <- E].

Lemma cam_rowsub P v : cam (rowsub s P) v = cam P (s v).
Proof. by rewrite /cam; congr vec_mx; apply/rowP=> j; rewrite !mxE. Qed.

Lemma J_local (E : seq ('I_k * 'I_k)) P : (\rank (J (moved E) P) <= \rank (J E (rowsub s P)))%N.
Proof.
apply: leq_trans (mxrankM_maxr (lin_mx (rowsub s)) _).
apply: rank_by_ker; apply/rV_subP=> u /sub_kermxP; rewrite mulmxA => /eqP.
rewrite J_ker J_kerP => /allP h; apply/allP=> _ /mapP [e eE ->].
by have := h e eE; rewrite mul_rV_lin mxvecK /equation !cam_rowsub.
Qed.
End Ranks.
