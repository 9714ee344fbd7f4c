(* Section 2: the equations at cameras [I | -c_v], entry by entry. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(* One text for the formulas in a ring and for those that the program computes with numbers modulo p. *)
Section Formulas.
Variables (K : Type) (zero : K) (add mul : K -> K -> K) (opp : K -> K).
Variables ci cj : nat -> K.
Definition diff k := add (ci k) (opp (cj k)).

(* F = -[d]_x for d = c_i - c_j *)
Definition F_entry (h k : nat) : K :=
  match h, k with
  | 0, 1 => diff 2 | 0, 2 => opp (diff 1) | 1, 0 => opp (diff 2)
  | 1, 2 => diff 0 | 2, 0 => diff 1 | 2, 1 => opp (diff 0) | _, _ => zero
  end%N.

(* M^T = P_j^T F of (2.1) *)
Definition M_entry (a h : nat) : K :=
  if (a < 3)%N then F_entry a h
  else opp (add (mul (cj 0%N) (F_entry 0 h)) (add (mul (cj 1%N) (F_entry 1 h)) (mul (cj 2%N) (F_entry 2 h)))).

(* the column of J_P for entry (h, b) of dP_v *)
Definition key (v h b : nat) : nat := (12 * v + (4 * h + b))%N.

(* entry (a, b) of the equation of (i, j), as a combination of entries of dP *)
Definition combination (i j a b : nat) : seq (nat * K) :=
  [:: (key i 0 b, M_entry a 0); (key i 1 b, M_entry a 1); (key i 2 b, M_entry a 2);
      (key i 0 a, M_entry b 0); (key i 1 a, M_entry b 1); (key i 2 a, M_entry b 2);
      (key j 0 b, opp (M_entry a 0)); (key j 1 b, opp (M_entry a 1)); (key j 2 b, opp (M_entry a 2));
      (key j 0 a, opp (M_entry b 0)); (key j 1 a, opp (M_entry b 1)); (key j 2 a, opp (M_entry b 2))].
End Formulas.

Section Normal.
Variables (R : comRingType) (n : nat).
Implicit Types (c : nat -> nat -> R) (u : cameras R n).

Definition normal_entry c (v i k : nat) : R := if (k < 3)%N then (i == k)%:R else - c v i.
Definition normal c : cameras R n := \matrix_v mxvec (mx 3 4 (normal_entry c v)).
Lemma cam_normal c v : cam (normal c) v = mx 3 4 (normal_entry c v).
Proof. by rewrite /cam rowK mxvecK. Qed.

Notation F c i j := (F_entry 0 +%R -%R (c i) (c j)).
Notation M c i j := (M_entry 0 +%R *%R -%R (c i) (c j)).

Lemma fund_normal c i j : fund (mx 3 4 (normal_entry c i)) (mx 3 4 (normal_entry c j)) = mx 3 3 (F c i j).
Proof.
rewrite fund_stack; apply/matrixP=> h k; rewrite !mxE.
case: h => [h hh]; case: k => [k hk] /=; rewrite det4_laplace // /laplace /two /F_entry /diff /normal_entry.
by move: h k hh hk; case=> [|[|[|//]]]; case=> [|[|[|//]]] _ _ /=;
  rewrite ?add0n ?addn0 ?add1n ?exprS ?expr0; ring.
Qed.

Lemma left_i c i j : (mx 3 4 (normal_entry c j))^T *m mx 3 3 (F c i j) = mx 4 3 (M c i j).
Proof.
apply/matrixP=> a h; rewrite !mxE !big_ord_recl big_ord0 !mxE /= /bump /= ?add1n ?addn0.
case: a => [a ha]; case: h => [h hh] /=; rewrite /M_entry /F_entry /diff /normal_entry.
by move: a h ha hh; case=> [|[|[|[|//]]]]; case=> [|[|[|//]]] _ _ /=; ring.
Qed.

Lemma left_j c i j : (mx 3 4 (normal_entry c i))^T *m (mx 3 3 (F c i j))^T = - mx 4 3 (M c i j).
Proof.
apply/matrixP=> a h; rewrite !mxE !big_ord_recl big_ord0 !mxE /= /bump /= ?add1n ?addn0.
case: a => [a ha]; case: h => [h hh] /=; rewrite /M_entry /F_entry /diff /normal_entry.
by move: a h ha hh; case=> [|[|[|[|//]]]]; case=> [|[|[|//]]] _ _ /=; ring.
Qed.

(* coordinate k of a motion, and a combination of coordinates *)
Definition coord u (k : nat) : R :=
  if insub (k %/ 12)%N is Some v then cam u v (inord (k %% 12 %/ 4)) (inord (k %% 4)) else 0.
Definition value (y : seq (nat * R)) u := \sum_(kx <- y) kx.2 * coord u kx.1.

Lemma coord_key u (v : 'I_n) (h : 'I_3) (b : 'I_4) : coord u (key v h b) = cam u v h b.
Proof.
have hb : (4 * h + b < 12)%N by case: h b => [h ?] [b ?] /=; lia.
rewrite /coord /key [(12 * _)%N]mulnC divnMDl // (divn_small hb) addn0 valK.
rewrite modnMDl (modn_small hb) [(4 * _)%N]mulnC divnMDl // (divn_small (ltn_ord b)) addn0.
have -> : (v * 12 = v * 3 * 4)%N by lia.
by rewrite modnMDl modnMDl (modn_small (ltn_ord b)) !inord_val.
Qed.

Lemma coord_linear k : scalar (fun u => coord u k).
Proof.
move=> a u w; rewrite /coord; case: insub => [v|]; last by rewrite mulr0 addr0.
by rewrite camP !mxE.
Qed.

Lemma coord0 u : (forall k, (k < 12 * n)%N -> coord u k = 0) -> u = 0.
Proof.
move=> h; apply/row_matrixP=> v; rewrite row0; apply/eqP.
rewrite -[row v u]vec_mxK mxvec_eq0; apply/eqP/matrixP=> i b; rewrite [RHS]mxE.
rewrite -[vec_mx _]/(cam u v) -coord_key h // /key.
by case: v i b => [v hv] [i hi] [b hb] /=; lia.
Qed.

Theorem equation_normal c (i j : 'I_n) (a b : 'I_4) u :
  equation (normal c) (i, j) u a b = value (combination 0 +%R *%R -%R (c i) (c j) i j a b) u.
Proof.
pose h0 : 'I_3 := ord0; pose h1 : 'I_3 := lift ord0 ord0; pose h2 : 'I_3 := lift ord0 (lift ord0 ord0).
rewrite /equation /= !cam_normal fund_normal left_i left_j mulNmx -mulmxBr.
rewrite /value /combination !big_cons big_nil.
rewrite (coord_key u i h0 b) (coord_key u i h1 b) (coord_key u i h2 b).
rewrite (coord_key u i h0 a) (coord_key u i h1 a) (coord_key u i h2 a).
rewrite (coord_key u j h0 b) (coord_key u j h1 b) (coord_key u j h2 b).
rewrite (coord_key u j h0 a) (coord_key u j h1 a) (coord_key u j h2 a).
rewrite !mxE !big_ord_recl !big_ord0 !mxE -/h0 -/h1 -/h2 /=.
rewrite -[bump 0 0]/1%N -[bump 0 1]/2%N.
by move: (M c i j) => g; ring.
Qed.
End Normal.
