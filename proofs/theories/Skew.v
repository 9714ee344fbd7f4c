(* Section 1 of docs/theory.md: S = P_j^T F_ij P_i is skew-symmetric, an identity of polynomials.

   [ring] is quick on a few dozen monomials and lost on thousands. So determinants are expanded into 2 x 2 minors,
   and each identity is put to [ring] with the minors as unknowns. Entries are functions of plain numbers here. *)
From mathcomp Require Import all_ssreflect all_algebra ring.
From Viewcert Require Import Statement.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Skew.
Variable R : comRingType.
Implicit Types f g a b : nat -> nat -> R.

Definition mx m n f : 'M[R]_(m, n) := \matrix_(i, j) f i j.

Lemma mx_id m n (A : 'M[R]_(m.+1, n.+1)) : A = mx _ _ (fun i j => A (inord i) (inord j)).
Proof. by apply/matrixP=> i j; rewrite mxE !inord_val. Qed.

(* determinants, by the first row *)
Definition det2 g := g 0%N 0%N * g 1%N 1%N - g 0%N 1%N * g 1%N 0%N.
Definition minor g (j : nat) := fun r c => g r.+1 (bump j c).
Definition det3 g :=
  g 0%N 0%N * det2 (minor g 0) - g 0%N 1%N * det2 (minor g 1) + g 0%N 2%N * det2 (minor g 2).
Definition det4 g :=
  g 0%N 0%N * det3 (minor g 0) - g 0%N 1%N * det3 (minor g 1)
  + g 0%N 2%N * det3 (minor g 2) - g 0%N 3%N * det3 (minor g 3).

Lemma minorE n g (j : 'I_n.+1) : row' ord0 (col' j (mx n.+1 n.+1 g)) = mx n n (minor g j).
Proof. by apply/matrixP=> r c; rewrite !mxE. Qed.

Lemma det2E g : \det (mx 2 2 g) = det2 g.
Proof.
rewrite (expand_det_row _ ord0) !big_ord_recl big_ord0 /cofactor !minorE !det_mx11 !mxE /=.
by rewrite /det2 /minor /bump /= !addn0 ?add1n ?addn1 ?add0n !exprS !expr0; ring.
Qed.

Lemma det3E g : \det (mx 3 3 g) = det3 g.
Proof.
rewrite (expand_det_row _ ord0) !big_ord_recl big_ord0 /cofactor !minorE !det2E !mxE /=.
rewrite /det3 /bump /= !addn0 ?add1n ?addn1 ?add0n !exprS !expr0.
by move: (det2 (minor g 0)) (det2 (minor g 1)) (det2 (minor g 2)) => x y z; ring.
Qed.

Lemma det4E g : \det (mx 4 4 g) = det4 g.
Proof.
rewrite (expand_det_row _ ord0) !big_ord_recl big_ord0 /cofactor !minorE !det3E !mxE /=.
rewrite /det4 /bump /= !addn0 ?add1n ?addn1 ?add0n !exprS !expr0.
by move: (det3 (minor g 0)) (det3 (minor g 1)) (det3 (minor g 2)) (det3 (minor g 3)) => x y z t; ring.
Qed.

(* the rows of a without row k, then those of b without row h *)
Definition stack a b (h k r c : nat) : R := if (r < 2)%N then a (bump k r) c else b (bump h (r - 2)) c.

Lemma fund_stack a b : fund (mx 3 4 a) (mx 3 4 b) =
  mx 3 3 (fun h k => (-1) ^+ (h + k) * det4 (stack a b h k)).
Proof.
apply/matrixP=> h k; rewrite !mxE -det4E; congr (_ * \det _).
apply/matrixP=> r c; rewrite !mxE /stack; case: split_ordP => s es.
  by rewrite !mxE es /= ltn_ord.
by rewrite !mxE es /= ?subSS ?subn0.
Qed.

(* Laplace: F is bilinear in the 2 x 2 minors of both cameras; [two a k p q] is that without row k, columns p, q *)
Definition two a k p q :=
  match k with
  | 0 => a 1%N p * a 2%N q - a 1%N q * a 2%N p
  | 1 => a 0%N p * a 2%N q - a 0%N q * a 2%N p
  | _ => a 0%N p * a 1%N q - a 0%N q * a 1%N p
  end.
Arguments two : simpl never.

Definition laplace a b h k :=
  two a k 0 1 * two b h 2 3 - two a k 0 2 * two b h 1 3 + two a k 0 3 * two b h 1 2
  + two a k 1 2 * two b h 0 3 - two a k 1 3 * two b h 0 2 + two a k 2 3 * two b h 0 1.

Lemma det4_laplace a b h k : (h < 3)%N -> (k < 3)%N -> det4 (stack a b h k) = laplace a b h k.
Proof.
rewrite /det4 /det3 /det2 /minor /stack /bump /laplace /two.
by move: h k; case=> [|[|[|//]]]; case=> [|[|[|//]]] _ _;
  rewrite /= ?subSS ?subn0 ?addn0 ?add1n ?add0n; ring.
Qed.

(* entry (c, d) of S *)
Definition entry a b (c d : nat) : R :=
  let f h k := (-1) ^+ (h + k) * det4 (stack a b h k) in
  let g h := f h 0%N * a 0%N d + f h 1%N * a 1%N d + f h 2%N * a 2%N d in
  b 0%N c * g 0%N + b 1%N c * g 1%N + b 2%N c * g 2%N.

Lemma entryE a b (c d : 'I_4) :
  ((mx 3 4 b)^T *m fund (mx 3 4 a) (mx 3 4 b) *m mx 3 4 a) c d = entry a b c d.
Proof.
rewrite fund_stack -mulmxA mxE !big_ord_recl big_ord0 !mxE !big_ord_recl !big_ord0 !mxE /= /bump /=.
by rewrite /entry !addr0 !addrA.
Qed.

(* the 3 x 3 minor of a with columns d, p, q: alternating *)
Definition three a d p q := a 0%N d * two a 0 p q - a 1%N d * two a 1 p q + a 2%N d * two a 2 p q.
Arguments three : simpl never.
Lemma three_left a p q : three a p p q = 0. Proof. by rewrite /three /two; ring. Qed.
Lemma three_right a p q : three a q p q = 0. Proof. by rewrite /three /two; ring. Qed.
Lemma three_swap a d p q : three a p d q = - three a d p q. Proof. by rewrite /three /two; ring. Qed.
Lemma three_turn a d p q : three a q d p = three a d p q. Proof. by rewrite /three /two; ring. Qed.

Lemma entry_three a b c d : entry a b c d =
    three a d 0 1 * three b c 2 3 - three a d 0 2 * three b c 1 3 + three a d 0 3 * three b c 1 2
  + three a d 1 2 * three b c 0 3 - three a d 1 3 * three b c 0 2 + three a d 2 3 * three b c 0 1.
Proof.
rewrite /entry !det4_laplace // /laplace /three /= ?addn0 ?add1n ?add0n !exprS !expr0.
do 36! [match goal with |- context [two ?f ?k ?p ?q] =>
  let x := fresh "x" in set x := (two f k p q); clearbody x end].
by ring.
Qed.

Lemma entry_skew a b c d : (c < 4)%N -> (d < 4)%N -> entry a b c d + entry a b d c = 0.
Proof.
rewrite !entry_three; move: c d; case=> [|[|[|[|//]]]]; case=> [|[|[|[|//]]]] _ _;
rewrite ?three_left ?three_right ?(three_swap _ 0 1 2) ?(three_swap _ 0 1 3) ?(three_swap _ 0 2 3)
  ?(three_swap _ 1 2 3) ?(three_turn _ 0 1 2) ?(three_turn _ 0 1 3) ?(three_turn _ 0 2 3) ?(three_turn _ 1 2 3);
do ?[match goal with |- context [three ?f ?k ?p ?q] =>
  let x := fresh "x" in set x := (three f k p q); clearbody x end]; by ring.
Qed.

Lemma skew (A B : 'M[R]_(3, 4)) : let S := B^T *m fund A B *m A in S^T = - S.
Proof.
move=> S; apply/eqP; rewrite -addr_eq0; apply/eqP/matrixP=> c d.
rewrite [RHS]mxE [LHS]mxE [in X in X + _]mxE /S (mx_id A) (mx_id B) !entryE.
by apply: entry_skew.
Qed.

(* the pair turned round, and a node paired with itself *)
Lemma fund_swap (A B : 'M[R]_(3, 4)) : fund B A = (fund A B)^T.
Proof.
rewrite (mx_id A) (mx_id B) !fund_stack; apply/matrixP=> h k; rewrite !mxE !det4_laplace // addnC.
by congr (_ * _); rewrite /laplace; move: (two _) (two _) => x y; ring.
Qed.

Lemma fund_loop (A : 'M[R]_(3, 4)) : fund A A = 0.
Proof.
rewrite (mx_id A) fund_stack; apply/matrixP=> h k; rewrite !mxE det4_laplace // /laplace /two.
by move: h k; do 2! (case=> [[|[|[|//]]] ?]); rewrite /=; ring.
Qed.
End Skew.
