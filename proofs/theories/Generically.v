(* Section 1: what holds for generic cameras. A condition holds generically if it does wherever some polynomial in the
   entries of the cameras, which is not zero everywhere, is not zero. Ranks at one camera set give such conditions, and two of
   them hold together. *)
From mathcomp Require Import all_ssreflect perm all_algebra.
From Viewcert Require Import Statement Skew Motions Generic.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

Section Generically.
Variables n k : nat.

Lemma map_evaluate (R S : comRingType) (f : {rmorphism R -> S}) (P : 'M[R]_(n, k)) q :
  f (evaluate P q) = evaluate (map_mx f P) q.
Proof.
elim: q => [c|v i|a iha b ihb|a iha b ihb] /=; first exact: rmorph_int.
- by rewrite mxE.
- by rewrite rmorphD iha ihb.
- by rewrite rmorphM iha ihb.
Qed.

Lemma generically_impl (C D : forall F : numFieldType, 'M[F]_(n, k) -> Prop) :
  (forall F P, C F P -> D F P) -> @generically n k C -> @generically n k D.
Proof. by move=> h [q nz c]; exists q => // F P /c /h. Qed.

Lemma generically_true (C : forall F : numFieldType, 'M[F]_(n, k) -> Prop) : (forall F P, C F P) -> @generically n k C.
Proof. by move=> h; exists (Number n k 1) => //; exists 0. Qed.

Lemma generically_and (C D : forall F : numFieldType, 'M[F]_(n, k) -> Prop) :
  @generically n k C -> @generically n k D -> @generically n k (fun F P => C F P /\ D F P).
Proof.
move=> [q1 [P1 nz1] c1] [q2 [P2 nz2] c2]; exists (Times q1 q2) => [|F P /=]; last first.
  by rewrite mulf_eq0 negb_or => /andP [/c1 h1 /c2 h2].
pose L := line (P1 : 'M[[numFieldType of rat]]_(n, k)) P2.
have ev (t : rat) q : (evaluate L q).[t] = evaluate (P1 + t *: (P2 - P1) : 'M[rat_comRing]_(n, k)) q.
  by rewrite -[_.[t]]/(horner_eval t _) map_evaluate ev_line.
have n1 : evaluate L q1 != 0.
  apply: contraNneq nz1 => z; have := ev 0 q1; rewrite z horner0 scale0r addr0 => <-.
  by [].
have n2 : evaluate L q2 != 0.
  apply: contraNneq nz2 => z; have := ev 1 q2; rewrite z horner0 scale1r addrC subrK => <-.
  by [].
have [i] := nonroot (mulf_neq0 n1 n2); rewrite hornerM !ev => nz.
by exists (P1 + i%:R *: (P2 - P1)).
Qed.

Lemma generically_all (T : eqType) (s : seq T) (C : T -> forall F : numFieldType, 'M[F]_(n, k) -> Prop) :
  (forall x, x \in s -> @generically n k (C x)) -> @generically n k (fun F P => forall x, x \in s -> C x F P).
Proof.
elim: s => [|x s ih] h; first exact: generically_true.
have hs : @generically n k (fun F P => forall y, y \in s -> C y F P) by apply: ih => y ys; apply: h; rewrite inE ys orbT.
apply: generically_impl (generically_and (h x (mem_head _ _)) hs) => F P [hx hy] y.
by rewrite inE => /predU1P [-> | /hy].
Qed.

(* families of functions that are polynomials *)
Definition is_polynomial (f : forall R : comRingType, 'M[R]_(n, k) -> R) : Prop :=
  exists q, forall (R : comRingType) (P : 'M[R]_(n, k)), evaluate P q = f R P.

Lemma poly_number c : is_polynomial (fun R P => c%:~R).
Proof. by exists (Number n k c). Qed.
Lemma poly_entry v i : is_polynomial (fun R P => P v i).
Proof. by exists (Entry v i). Qed.
Lemma poly_add f g : is_polynomial f -> is_polynomial g -> is_polynomial (fun R P => f R P + g R P).
Proof. by move=> [a ha] [b hb]; exists (Plus a b) => R P /=; rewrite ha hb. Qed.
Lemma poly_mul f g : is_polynomial f -> is_polynomial g -> is_polynomial (fun R P => f R P * g R P).
Proof. by move=> [a ha] [b hb]; exists (Times a b) => R P /=; rewrite ha hb. Qed.
Lemma poly_opp f : is_polynomial f -> is_polynomial (fun R P => - f R P).
Proof. by move=> [a ha]; exists (Times (Number n k (-1)) a) => R P /=; rewrite ha mulN1r. Qed.
Lemma poly_eq f g : (forall R P, f R P = g R P) -> is_polynomial f -> is_polynomial g.
Proof. by move=> e [a ha]; exists a => R P; rewrite ha. Qed.
Lemma poly_sum (I : Type) (s : seq I) (f : I -> forall R : comRingType, 'M[R]_(n, k) -> R) :
  (forall i, is_polynomial (f i)) -> is_polynomial (fun R P => \sum_(i <- s) f i R P).
Proof.
move=> h; elim: s => [|i s ih].
  by apply: poly_eq (poly_number 0) => R P; rewrite big_nil.
by apply: poly_eq (poly_add (h i) ih) => R P; rewrite big_cons.
Qed.
Lemma poly_prod (I : Type) (s : seq I) (f : I -> forall R : comRingType, 'M[R]_(n, k) -> R) :
  (forall i, is_polynomial (f i)) -> is_polynomial (fun R P => \prod_(i <- s) f i R P).
Proof.
move=> h; elim: s => [|i s ih].
  by apply: poly_eq (poly_number 1) => R P; rewrite big_nil.
by apply: poly_eq (poly_mul (h i) ih) => R P; rewrite big_cons.
Qed.

(* matrices of polynomials *)
Definition polynomial_matrix p q (A : forall R : comRingType, 'M[R]_(n, k) -> 'M[R]_(p, q)) : Prop :=
  forall i j, is_polynomial (fun R P => A R P i j).
Lemma poly_det p (A : forall R : comRingType, 'M[R]_(n, k) -> 'M[R]_p) :
  polynomial_matrix A -> is_polynomial (fun R P => \det (A R P)).
Proof.
move=> h; have pp (s : {perm 'I_p}) : is_polynomial (fun R P => \prod_i A R P i (s i)) by apply: poly_prod => i; exact: h.
have ps (s : {perm 'I_p}) : is_polynomial (fun R P => (-1) ^+ s * \prod_i A R P i (s i)).
  apply: poly_eq (poly_mul (poly_number ((-1) ^+ s)) (pp s)) => R P.
  by rewrite rmorphX rmorphN rmorph1.
by apply: poly_eq (poly_sum _ ps) => R P.
Qed.

(* A rank that is attained at some rational cameras holds generically. *)
Theorem rank_generically p q (A : forall R : comRingType, 'M[R]_(n, k) -> 'M[R]_(p, q)) r (P0 : 'M[rat_comRing]_(n, k)) :
  polynomial_matrix A -> (r <= \rank (A _ P0 : 'M[rat]_(p, q)))%N ->
  @generically n k (fun F P => (r <= \rank (A F P))%N).
Proof.
move=> pA le; pose A0 : 'M[rat]_(p, q) := A _ P0; pose s := maxrankfun A0; pose B := rowsub s A0.
have rB : \rank B = \rank A0 by apply/eqP; exact: (maxrowsub_free A0).
pose t := maxrankfun B^T; pose C (R : comRingType) P := rowsub t (rowsub s (A R P))^T.
have rBt : \rank B^T = \rank A0 by rewrite mxrank_tr.
pose C' (R : comRingType) (P : 'M[R]_(n, k)) : 'M[R]_(\rank A0) := rowsub (t \o cast_ord (esym rBt)) (rowsub s (A R P))^T.
have pC : polynomial_matrix C'.
  by move=> i j; apply: poly_eq (pA (s j) ((t \o cast_ord (esym rBt)) i)) => R P; rewrite /C' !mxE.
have [d hd] := poly_det pC; exists d; last first.
  move=> F P; rewrite hd -unitfE -unitmxE => u; apply: leq_trans le _.
  have := mxrank_unit u; rewrite -/A0 => <-; apply: leq_trans (mxrankS (rowsub_sub _ _)) _.
  by rewrite mxrank_tr; apply/mxrankS/rowsub_sub.
exists P0; rewrite hd -unitfE -unitmxE -row_free_unit /C' -/A0 -/B.
have free l (e : l = \rank B^T) : row_free (rowsub (t \o cast_ord e) B^T).
  subst l; have -> : rowsub (t \o cast_ord erefl) B^T = rowsub t B^T by apply/matrixP=> i j; rewrite !mxE /= cast_ord_id.
  exact: maxrowsub_free.
exact: free.
Qed.
End Generically.

Lemma poly_camera n v h k : @is_polynomial n (3 * 4) (fun R P => cam P v h k).
Proof. by apply: poly_eq (poly_entry v (mxvec_index h k)) => R P; rewrite !mxE. Qed.
