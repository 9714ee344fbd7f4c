(* Section 1, Proposition 1.4 and Lemma 1.1: from one camera set to another.

   Nothing here needs Zariski's topology. A rank that is attained at one camera set is attained at all but finitely
   many points of any line through it. So of two camera sets, each good for one purpose, a point of the line between
   them is good for both. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Line.
Variable F : numFieldType.
Notation ev t := (map_mx (horner_eval (t : F))).

Lemma rank_open p q (A : 'M[{poly F}]_(p, q)) a :
  exists Q : {poly F}, Q != 0 /\ forall t, Q.[t] != 0 -> (\rank (ev a A) <= \rank (ev t A))%N.
Proof.
set M := ev a A.
have /row_fullP [U hU] := col_base_full M.
have /row_freeP [V hV] := row_base_free M.
have UV : U *m M *m V = 1%:M.
  have -> : U *m M *m V = U *m (col_base M *m row_base M) *m V by rewrite mulmx_base.
  by rewrite mulmxA hU mul1mx hV.
pose Q := \det (map_mx polyC U *m A *m map_mx polyC V).
have Qt t : Q.[t] = \det (U *m ev t A *m V).
  rewrite -[Q.[t]]/(horner_eval t Q) -det_map_mx !map_mxM -!map_mx_comp.
  by do !congr (\det _); congr (_ *m _ *m _); apply: map_mx_id_in => i j /=; rewrite /horner_eval hornerC.
exists Q; split=> [|t].
  have : Q.[a] != 0 by rewrite Qt UV det1 oner_eq0.
  by apply: contraNneq => ->; rewrite horner0.
rewrite Qt -unitfE -unitmxE => u.
have <- : \rank (U *m ev t A *m V) = \rank M by apply: mxrank_unit.
by apply: leq_trans (mxrankM_maxl _ _) (mxrankM_maxr _ _).
Qed.

Lemma nonroot (Q : {poly F}) : Q != 0 -> exists k : nat, Q.[k%:R] != 0.
Proof.
move=> n0; pose s := [seq i%:R : F | i <- iota 0 (size Q)].
have us : uniq s by rewrite map_inj_uniq ?iota_uniq // => x y /eqP; rewrite eqr_nat => /eqP.
case/boolP: (all (root Q) s) => [al | /allPn [_ /mapP [k _ ->] h]]; last by exists k.
by have := max_poly_roots n0 al us; rewrite size_map size_iota ltnn.
Qed.

(* of n cameras, or n points: matrices with n rows *)
Variables n k : nat.
Implicit Types P : 'M[F]_(n, k).

Definition line P0 P1 : 'M[[comRingType of {poly F}]]_(n, k) := map_mx polyC P0 + 'X *: map_mx polyC (P1 - P0).

Lemma ev_line P0 P1 t : ev t (line P0 P1) = P0 + t *: (P1 - P0).
Proof.
rewrite /line map_mxD map_mxZ -!map_mx_comp /= /horner_eval hornerX.
congr (_ + _ *: _).
  by apply: map_mx_id_in => i j /=; rewrite hornerC.
by apply: map_mx_id_in => i j /=; rewrite hornerC.
Qed.

(* Two matrices of polynomials in the cameras: some cameras have for both at least the rank that they have at P0, P1. *)
Lemma both p1 q1 p2 q2 (A1 : forall R : comRingType, 'M[R]_(n, k) -> 'M[R]_(p1, q1))
    (A2 : forall R : comRingType, 'M[R]_(n, k) -> 'M[R]_(p2, q2)) P0 P1 :
  (forall t, ev t (A1 _ (line P0 P1)) = A1 F (ev t (line P0 P1))) ->
  (forall t, ev t (A2 _ (line P0 P1)) = A2 F (ev t (line P0 P1))) ->
  exists P, (\rank (A1 F P0) <= \rank (A1 F P))%N /\ (\rank (A2 F P1) <= \rank (A2 F P))%N.
Proof.
move=> m1 m2; have [Q1 [n1 h1]] := rank_open (A1 _ (line P0 P1)) 0.
have [Q2 [n2 h2]] := rank_open (A2 _ (line P0 P1)) 1.
have [i] : exists i : nat, (Q1 * Q2).[i%:R] != 0 by apply: nonroot; rewrite mulf_neq0.
rewrite hornerM mulf_eq0 negb_or => /andP [/h1 r1 /h2 r2].
rewrite !m1 !ev_line scale0r addr0 in r1; rewrite !m2 !ev_line scale1r addrC subrK in r2.
by exists (P0 + i%:R *: (P1 - P0)).
Qed.
End Line.

Section Cameras.
Variables (F : numFieldType) (n : nat).
Implicit Types P : cameras F n.

Lemma both_J E1 E2 (P0 P1 : cameras F n) :
  exists P, (\rank (J E1 P0) <= \rank (J E1 P))%N /\ (\rank (J E2 P1) <= \rank (J E2 P))%N.
Proof.
by apply: (@both F n _ _ _ _ _ (fun R U => J E1 U) (fun R U => J E2 U) P0 P1) => t; rewrite map_J.
Qed.

(* cameras with trivial motions of dimension d: then rank J <= 12 n - d everywhere *)
Lemma rank_everywhere E (P0 P : cameras F n) : (\rank (J E P) <= n * 12 - \rank (T P0))%N.
Proof.
have [||Q [r1 r2]] := @both F n _ _ _ _ _ (fun R (U : cameras R n) => T U) (fun R U => J E U) P0 P.
- by move=> t; rewrite map_T.
- by move=> t; rewrite map_J.
by have := mulmx0_rank_max (T_J E Q); lia.
Qed.
End Cameras.

(* Lemma 1.1. Explicit cameras with n + 15 trivial motions: [I | -c_v], c_0 = 0, all others e_1. *)
Section Bound.
Variable F : numFieldType.

Definition good_entry (b : bool) (i k : nat) : F := (i == k)%:R - (b && (i == 0%N) && (k == 3%N))%:R.
Definition good n : cameras F n.+2 := \matrix_v mxvec (mx 3 4 (good_entry (v != ord0))).

Lemma rank_good n : (16 + n.+2 - 1 <= \rank (T (good n)))%N.
Proof.
set P := good _; have -> : \rank (T P) = (16 + n.+2 - \rank (kermx (T P)))%N.
  by rewrite mxrank_ker subKn ?rank_leq_row.
apply: leq_sub2l.
suff : (kermx (T P) <= row_mx (mxvec (1%:M : 'M_4)) (const_mx (-1) : 'rV_n.+2))%MS.
  by move/mxrankS/leq_trans; apply; rewrite rank_leq_row.
apply/rV_subP=> u /sub_kermxP; rewrite mul_rV_lin1 /= => /eqP.
rewrite mxvec_eq0 => /eqP h.
pose X : 'M_4 := vec_mx (lsubmx u); pose mu := rsubmx u.
pose x i j := X (inord i) (inord j); have hX : X = mx 4 4 x by apply: mx_id.
have ent v i j : (i < 3)%N -> (j < 4)%N -> let p := good_entry (v != ord0) in
    p i 0%N * x 0%N j + p i 1%N * x 1%N j + p i 2%N * x 2%N j + p i 3%N * x 3%N j + mu 0 v * p i j = 0.
  move=> hi hj p; have := congr1 (row v) h; rewrite rowK row0 => /eqP.
  rewrite mxvec_eq0 {1 2}/cam rowK mxvecK -/X -/mu hX => /eqP/matrixP.
  move/(_ (Ordinal hi) (Ordinal hj)); rewrite !mxE !big_ord_recl big_ord0 !mxE /= /bump /=.
  by rewrite !addr0 !addrA.
pose m0 := mu 0 ord0.
have e0 i j : (i < 3)%N -> (j < 4)%N -> x i j = - m0 * (i == j)%:R.
  move=> hi hj; have := ent ord0 i j hi hj; rewrite /good_entry eqxx /= !subr0 -/m0.
  by case: i hi => [|[|[|//]]] _ /=; rewrite !(mul1r, mul0r, addr0, add0r) => /eqP;
    rewrite addr_eq0 => /eqP ->; rewrite mulNr.
have em v : mu 0 v = m0.
  case: (v =P ord0) => [-> //|/eqP nv].
  have := ent v 1%N 1%N isT isT; rewrite /good_entry nv /= !subr0.
  rewrite !(mul1r, mul0r, addr0, add0r, mulr1) (e0 1%N 1%N) //= mulr1 => /eqP.
  by rewrite addrC subr_eq0 => /eqP.
have e3 j : (j < 4)%N -> x 3%N j = - m0 * (3%N == j)%:R.
  move=> hj; have := ent (lift ord0 ord0) 0%N j isT hj; rewrite em e0 // /good_entry /=.
  move: (x 3%N) => x3; case: j hj => [|[|[|[|//]]]] _ /= h0; apply/eqP;
    rewrite -subr_eq0 -oppr_eq0; apply/eqP; rewrite -{}h0; ring.
apply/sub_rVP; exists (- m0); rewrite -[u]hsubmxK scale_row_mx; congr row_mx.
  rewrite -[lsubmx u]vec_mxK -linearZ /= -/X; congr mxvec; apply/matrixP=> i j.
  rewrite hX !mxE; case: (ltnP i 3) => hi; first by rewrite e0.
  have -> : nat_of_ord i = 3%N by apply/eqP; rewrite eqn_leq hi -ltnS ltn_ord.
  rewrite e3 //; congr (_ * (_)%:R); rewrite -val_eqE /=; congr (nat_of_bool (_ == _)).
  by apply/eqP; rewrite eqn_leq hi -ltnS ltn_ord.
by apply/rowP=> v; rewrite [LHS]em !mxE mulrN1 opprK.
Qed.

(* Lemma 1.1, at all cameras, whether or not their centres coincide *)
Theorem lemma_1_1 n E (P : cameras F n) : (2 <= n)%N -> (\rank (J E P) <= 11 * n - 15)%N.
Proof.
case: n E P => [|[|n]] // E P _.
by have := rank_everywhere E (good n) P; have := rank_good n; lia.
Qed.
End Bound.

(* Proposition 1.4: a rank modulo p is a lower bound over the rationals *)
Section Lift.
Variable p : nat.
Hypothesis p_prime : prime p.

Theorem proposition_1_4 m q (A : 'M[int]_(m, q)) :
  (\rank (map_mx (intr : int -> 'F_p) A) <= \rank (map_mx (intr : int -> rat) A))%N.
Proof.
set M := map_mx _ A.
have /row_fullP [U hU] := col_base_full M.
have /row_freeP [V hV] := row_base_free M.
have UV : U *m M *m V = 1%:M.
  have -> : U *m M *m V = U *m (col_base M *m row_base M) *m V by rewrite mulmx_base.
  by rewrite mulmxA hU mul1mx hV.
pose lift (x : 'F_p) : int := (val x)%:Z.
have liftK s t (B : 'M['F_p]_(s, t)) : map_mx intr (map_mx lift B) = B.
  by apply/matrixP=> i j; rewrite !mxE /lift -pmulrn natr_Zp.
pose Q := map_mx lift U *m A *m map_mx lift V.
have Q0 : \det Q != 0.
  have : (\det Q)%:~R != 0 :> 'F_p.
    by rewrite -[_%:~R]/(intmul1_rmorphism [ringType of 'F_p] _) -det_map_mx !map_mxM /= !liftK UV det1 oner_eq0.
  by apply: contraNneq => ->.
have : map_mx (intr : int -> rat) Q \in unitmx.
  by rewrite unitmxE (det_map_mx (intmul1_rmorphism rat_Ring)) unitfE /= intr_eq0.
move/mxrank_unit <-; rewrite !(map_mxM (intmul1_rmorphism rat_Ring)).
by apply: leq_trans (mxrankM_maxl _ _) (mxrankM_maxr _ _).
Qed.
End Lift.

(* What one set of rational cameras shows *)
Definition attained n (E : seq ('I_n * 'I_n)) (r : nat) : Prop :=
  exists P : cameras rat_comRing n, (r <= \rank (J E P : 'M[rat]_(_, _)))%N.

Lemma attained_mono n (E1 E2 : seq ('I_n * 'I_n)) r : {subset E1 <= E2} -> attained E1 r -> attained E2 r.
Proof. by move=> s [P h]; exists P; apply: leq_trans h (J_mono P s). Qed.

(* Cameras of some nodes serve for all: the others may stand anywhere. *)
Section Placing.
Variables (F : fieldType) (n k : nat) (s : 'I_k -> 'I_n).
Hypothesis s_inj : injective s.
Definition place : 'M[F]_(n, k) := \matrix_(v, i) (v == s i)%:R.

Lemma cam_place (u : cameras F k) i : cam (place *m u : cameras F n) (s i) = cam u i.
Proof.
rewrite /cam row_mul; have -> : row (s i) place = delta_mx 0 i.
  by apply/rowP=> j; rewrite !mxE /= (inj_eq s_inj) [j == i]eq_sym.
by rewrite -rowE.
Qed.

Lemma J_place (E : seq ('I_k * 'I_k)) (P : cameras F k) :
  (\rank (J E P) <= \rank (J (moved s E) (place *m P)))%N.
Proof.
apply: leq_trans (mxrankM_maxr (lin_mx (mulmx place)) _).
apply: rank_by_ker; apply/rV_subP=> u /sub_kermxP; rewrite mulmxA => /eqP.
rewrite J_ker J_kerP => /allP h; apply/allP=> e eE.
by have := h _ (map_f _ eE); rewrite mul_rV_lin mxvecK /equation !cam_place.
Qed.
End Placing.

Lemma attained_moved n k (s : 'I_k -> 'I_n) E r : injective s -> attained E r -> attained (moved s E) r.
Proof. by move=> i [P h]; exists (place [fieldType of rat] s *m P); apply: leq_trans h (J_place i E P). Qed.
