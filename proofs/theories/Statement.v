(* What has to be read: the objects that the proved checker speaks of, and the claims it makes.

   Theorem 1.3 of docs/theory.md (a graph is finite solvable iff [full_rank] holds) is not formal. It is cited from
   the literature, and no name before [solvable] says more than a rank. That [full_rank] is [directions_determine] is
   formal (Theorem 4.8, Parallel.v); that affine cameras are determined iff points in a plane are is Theorem 13.2 and
   is not. *)
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

(* ------------------------------------------------------------------ known directions
   n points in d dimensions, of which pairs tell in which direction one sees the other: centres of calibrated cameras
   whose rotations are known (d = 3), and the points of the affine model (d = 2; sections 4 and 13 of docs/theory.md). *)
Section Directions.
Variables (R : comRingType) (n d : nat).

(* row v is the point c_v *)
Definition points := 'M[R]_(n, d).
Definition displacement (c : points) (e : 'I_n * 'I_n) : 'rV[R]_d := row e.1 c - row e.2 c.

(* zero iff, over a field, the displacement of y is a multiple of that of c, or that of c is zero *)
Definition turned (c : points) (e : 'I_n * 'I_n) (y : points) : 'M[R]_d :=
  let u := displacement c e in let w := displacement y e in u^T *m w - w^T *m u.

(* N: the matrix of the linear map y |-> (turned c e y) for all e in E *)
Definition N (E : seq ('I_n * 'I_n)) (c : points) :=
  lin_mx (fun y : points => \matrix_(k < size E) mxvec (turned c (tnth (in_tuple E) k) y)).
End Directions.

(* The models, and the largest rank that a graph with n nodes can have in each: of J, or of N for points in space or in a
   plane *)
Inductive model := Projective | Calibrated | Affine.
Definition required M n : nat :=
  match M with Projective => 11 * n - 15 | Calibrated => 3 * n - 4 | Affine => 2 * n - 3 end%N.

(* The graph with nodes 0 .. n-1 and m pairs, the k-th of which is (first k, second k) *)
Definition pairs m (first second : nat -> nat) : seq (nat * nat) :=
  [seq (first k, second k) | k <- iota 0 m].

(* simple: two nodes at least, no loop, no pair twice or out of range *)
Definition well_formed n (G : seq (nat * nat)) : bool :=
  [&& 1 < n, all (fun e => e.1 < e.2 < n) G & uniq G]%N.

(* its pairs as pairs of nodes; in a well-formed graph none is left out (Sanity.edges_all) *)
Definition edges n (G : seq (nat * nat)) : seq ('I_n * 'I_n) :=
  pmap (fun e => if insub e.1 is Some i then if insub e.2 is Some j then Some (i, j) else None else None) G.

(* Some rational cameras (points) reach rank r. *)
Definition rank_at_least M n (G : seq (nat * nat)) (r : nat) : Prop :=
  match M with
  | Projective => exists P : cameras rat_comRing n, (r <= \rank (J (edges n G) P : 'M[rat]_(_, _)))%N
  | Calibrated => exists c : points rat_comRing n 3, (r <= \rank (N (edges n G) c : 'M[rat]_(_, _)))%N
  | Affine => exists c : points rat_comRing n 2, (r <= \rank (N (edges n G) c : 'M[rat]_(_, _)))%N
  end.

(* None over any field of numbers (numFieldType: the rationals, real, complex numbers, ..) exceed it. *)
Definition rank_at_most M n (G : seq (nat * nat)) (r : nat) : Prop :=
  forall F : numFieldType,
  match M with
  | Projective => forall P : cameras F n, (\rank (J (edges n G) P) <= r)%N
  | Calibrated => forall c : points F n 3, (\rank (N (edges n G) c) <= r)%N
  | Affine => forall c : points F n 2, (\rank (N (edges n G) c) <= r)%N
  end.

Definition generic_rank M n G r : Prop := [/\ well_formed n G, rank_at_least M n G r & rank_at_most M n G r].

(* the criterion of Theorem 1.3, of Theorem 4.8 and of Theorem 13.2 *)
Definition full_rank M n G : Prop := generic_rank M n G (required M n).

(* Sets of two nodes or more whose pairs have full rank among themselves, *)
Definition within (b : seq nat) (G : seq (nat * nat)) := [seq e <- G | (e.1 \in b) && (e.2 \in b)].
Definition part M n G b : Prop :=
  [/\ (1 < size b)%N, uniq b, all (fun v => v < n)%N b & rank_at_least M n (within b G) (required M (size b))].

(* the largest of them, and all of these *)
Definition component M n G b : Prop := part M n G b /\ forall b', part M n G b' -> {subset b <= b'} -> {subset b' <= b}.
Definition components M n G (C : seq (seq nat)) : Prop :=
  (forall b, b \in C -> component M n G b) /\ (forall b, component M n G b -> exists2 c, c \in C & c =i b).

(* Cameras Q have the fundamental matrices of P, up to factors; they are P, up to factors and one projectivity. *)
Definition same_matrices (F : fieldType) n (E : seq ('I_n * 'I_n)) (P Q : cameras F n) : Prop :=
  forall e, e \in E -> exists2 t : F, t != 0 & fund (cam Q e.1) (cam Q e.2) = t *: fund (cam P e.1) (cam P e.2).
Definition same_cameras (F : fieldType) n (P Q : cameras F n) (b : seq 'I_n) : Prop :=
  exists2 H : 'M[F]_4, H \in unitmx & forall v, v \in b -> exists2 t : F, t != 0 & cam Q v = t *: (cam P v *m H).

(* polynomials with integer coefficients in the entries of an n x k matrix, such as n cameras *)
Inductive polynomial n k :=
  | Number of int
  | Entry of 'I_n & 'I_k
  | Plus of polynomial n k & polynomial n k
  | Times of polynomial n k & polynomial n k.
Fixpoint evaluate (R : comRingType) n k (P : 'M[R]_(n, k)) (q : polynomial n k) : R :=
  match q with
  | Number c => c%:~R
  | Entry v k => P v k
  | Plus a b => evaluate P a + evaluate P b
  | Times a b => evaluate P a * evaluate P b
  end.

(* What holds for generic cameras: wherever some polynomial that is not zero everywhere is not zero. *)
Definition generically n k (C : forall F : numFieldType, 'M[F]_(n, k) -> Prop) : Prop :=
  exists2 q : polynomial n k, (exists P : 'M[rat_comRing]_(n, k), evaluate P q != 0) &
    forall (F : numFieldType) (P : 'M[F]_(n, k)), evaluate P q != 0 -> C F P.

(* Fundamental matrices determine generic cameras (section 1 of docs/theory.md). *)
Definition solvable n G : Prop := well_formed n G /\ @generically n (3 * 4) (fun F P =>
  forall Q, (forall v, \rank (cam Q v) = 3%N) -> same_matrices (edges n G) P Q -> same_cameras P Q (enum 'I_n)).

(* Points y have the directions of c, as lines; they are c, up to scale and translation. *)
Definition same_directions (F : fieldType) n d (E : seq ('I_n * 'I_n)) (c y : points F n d) : Prop :=
  forall e, e \in E -> exists2 t : F, t != 0 & displacement y e = t *: displacement c e.
Definition same_points (F : fieldType) n d (c y : points F n d) : Prop :=
  exists2 s : F, s != 0 & exists t : 'rV_d, forall v, row v y = s *: row v c + t.

(* Directions determine generic points. *)
Definition directions_determine d n G : Prop := well_formed n G /\ @generically n d (fun F c =>
  forall y, same_directions (edges n G) c y -> same_points c y).
