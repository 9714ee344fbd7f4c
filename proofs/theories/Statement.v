(* What has to be read: the objects that the proved checker speaks of, and the claims it makes.

   Theorem 1.3 of docs/theory.md (a graph is finite solvable iff [full_rank] holds) is not formal. It is cited from
   the literature, and no name before [solvable] says more than a rank. *)
From mathcomp Require Import all_ssreflect all_algebra.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory.
Local Open Scope ring_scope.

Section Equations.
Variables (R : comRingType) (n : nat).

(* n cameras: row v holds the 3 x 4 matrix P_v *)
Definition cameras := 'M[R]_(n, 3 * 4).
Definition cam (P : cameras) (v : 'I_n) : 'M[R]_(3, 4) := vec_mx (row v P).

(* (1.1): the fundamental matrix of A = P_i, B = P_j *)
Definition fund (A B : 'M[R]_(3, 4)) : 'M[R]_3 :=
  \matrix_(h, k) ((-1) ^+ (h + k) * \det (col_mx (row' k A) (row' h B) : 'M_4)).

(* (1.2): S + S^T for S = P_j^T F dP_i + P_i^T F^T dP_j, which is zero iff S is skew-symmetric *)
Definition equation (P : cameras) (e : 'I_n * 'I_n) (dP : cameras) : 'M[R]_4 :=
  let F := fund (cam P e.1) (cam P e.2) in
  let S := (cam P e.2)^T *m F *m cam dP e.1 + (cam P e.1)^T *m F^T *m cam dP e.2 in
  S + S^T.

(* J_P: the matrix of the linear map dP |-> (equation P e dP) for all e in E *)
Definition J (E : seq ('I_n * 'I_n)) (P : cameras) :=
  lin_mx (fun dP : cameras => \matrix_(k < size E) mxvec (equation P (tnth (in_tuple E) k) dP)).
End Equations.

(* The graph with nodes 0 .. n-1 and m pairs, the k-th of which is (first k, second k) *)
Definition pairs m (first second : nat -> nat) : seq (nat * nat) :=
  [seq (first k, second k) | k <- iota 0 m].

(* simple: two nodes at least, no loop, no pair twice or out of range *)
Definition well_formed n (G : seq (nat * nat)) : bool :=
  [&& 1 < n, all (fun e => e.1 < e.2 < n) G & uniq G]%N.

(* its pairs as pairs of nodes; in a well-formed graph none is left out (Sanity.edges_all) *)
Definition edges n (G : seq (nat * nat)) : seq ('I_n * 'I_n) :=
  pmap (fun e => if insub e.1 is Some i then if insub e.2 is Some j then Some (i, j) else None else None) G.

(* Some rational cameras reach rank r. *)
Definition rank_at_least n (G : seq (nat * nat)) (r : nat) : Prop :=
  exists P : cameras rat_comRing n, (r <= \rank (J (edges n G) P : 'M[rat]_(_, _)))%N.

(* No cameras over any field of numbers (numFieldType: the rationals, real, complex numbers, ..) exceed it. *)
Definition rank_at_most n (G : seq (nat * nat)) (r : nat) : Prop :=
  forall (F : numFieldType) (P : cameras F n), (\rank (J (edges n G) P) <= r)%N.

Definition generic_rank n G r : Prop := [/\ well_formed n G, rank_at_least n G r & rank_at_most n G r].

(* the criterion of Theorem 1.3 *)
Definition full_rank n G : Prop := generic_rank n G (11 * n - 15).

(* Sets of two nodes or more whose pairs have full rank among themselves, *)
Definition within (b : seq nat) (G : seq (nat * nat)) := [seq e <- G | (e.1 \in b) && (e.2 \in b)].
Definition part n G b : Prop :=
  [/\ (1 < size b)%N, uniq b, all (fun v => v < n)%N b & rank_at_least n (within b G) (11 * size b - 15)].

(* the largest of them, and all of these *)
Definition component n G b : Prop := part n G b /\ forall b', part n G b' -> {subset b <= b'} -> {subset b' <= b}.
Definition components n G (C : seq (seq nat)) : Prop :=
  (forall b, b \in C -> component n G b) /\ (forall b, component n G b -> exists2 c, c \in C & c =i b).

(* Cameras Q have the fundamental matrices of P, up to factors; they are P, up to factors and one projectivity. *)
Definition same_matrices (F : fieldType) n (E : seq ('I_n * 'I_n)) (P Q : cameras F n) : Prop :=
  forall e, e \in E -> exists2 t : F, t != 0 & fund (cam Q e.1) (cam Q e.2) = t *: fund (cam P e.1) (cam P e.2).
Definition same_cameras (F : fieldType) n (P Q : cameras F n) (b : seq 'I_n) : Prop :=
  exists2 H : 'M[F]_4, H \in unitmx & forall v, v \in b -> exists2 t : F, t != 0 & cam Q v = t *: (cam P v *m H).

(* polynomials with integer coefficients in the entries of n cameras *)
Inductive polynomial n :=
  | Number of int
  | Entry of 'I_n & 'I_(3 * 4)
  | Plus of polynomial n & polynomial n
  | Times of polynomial n & polynomial n.
Fixpoint evaluate (R : comRingType) n (P : cameras R n) (q : polynomial n) : R :=
  match q with
  | Number c => c%:~R
  | Entry v k => P v k
  | Plus a b => evaluate P a + evaluate P b
  | Times a b => evaluate P a * evaluate P b
  end.

(* What holds for generic cameras: wherever some polynomial that is not zero everywhere is not zero. *)
Definition generically n (C : forall F : numFieldType, cameras F n -> Prop) : Prop :=
  exists2 q : polynomial n, (exists P : cameras rat_comRing n, evaluate P q != 0) &
    forall (F : numFieldType) (P : cameras F n), evaluate P q != 0 -> C F P.

(* Fundamental matrices determine generic cameras (section 1 of docs/theory.md). *)
Definition solvable n G : Prop := well_formed n G /\ @generically n (fun F P =>
  forall Q, (forall v, \rank (cam Q v) = 3%N) -> same_matrices (edges n G) P Q -> same_cameras P Q (enum 'I_n)).
