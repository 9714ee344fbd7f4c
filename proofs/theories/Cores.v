(* The rank of a core modulo the prime of the program, and what a motion says of its pairs, in each model. *)
From mathcomp Require Import all_ssreflect all_algebra.
From Viewcert Require Import Statement Generic NormalForm Rigid Directions Models Elimination Bearing Flows.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Definition the_prime : nat := 2 ^ 16 - 15.
Definition in_space : seq (nat * nat) := [:: (0, 1); (0, 2); (1, 2)].
Definition in_plane : seq (nat * nat) := [:: (0, 1)].

Section Program.
Variables (M : model) (cs : nat -> nat -> nat).
(* flows are those of Corollary 3.3; the rank of N needs none *)
Definition core_rank_in k (L : seq (nat * nat * nat)) (W : seq flow) : nat :=
  match M with
  | Projective => core_rank the_prime cs k L W
  | Calibrated => bearing_rank the_prime 3 in_space cs k L
  | Affine => bearing_rank the_prime 2 in_plane cs k L
  end.
Definition allows (motion : nat -> nat) i j : bool :=
  match M with
  | Projective => solved the_prime cs motion i j entries10
  | Calibrated => bearing_solved the_prime 3 in_space cs motion i j
  | Affine => bearing_solved the_prime 2 in_plane cs motion i j
  end.
Definition all_allow (motion : nat -> nat) (L : seq (nat * nat * nat)) : bool :=
  match M with
  | Projective => all_solved the_prime cs motion L
  | Calibrated => bearings_solved the_prime 3 in_space cs motion L
  | Affine => bearings_solved the_prime 2 in_plane cs motion L
  end.
End Program.

Lemma the_prime_is_prime : prime the_prime.
Proof. by vm_compute. Qed.
Lemma the_prime_is_odd : 2 < the_prime.
Proof. by vm_compute. Qed.
Lemma in_space_all g h : g < h -> h < 3 -> (g, h) \in in_space.
Proof. by case: h => [|[|[|//]]] //; case: g => [|[|//]]. Qed.
Lemma in_plane_all g h : g < h -> h < 2 -> (g, h) \in in_plane.
Proof. by case: h => [|[|//]] //; case: g. Qed.

Section Sound.
Variables (M : model) (n : nat) (cs : nat -> nat -> nat) (L : seq (nat * nat * nat)) (W : seq flow).
Hypothesis lt : all (fun e => (e.1.1 < n) && (e.1.2 < n)) L.
Local Notation E := (edges n (pairs_of L)).

Theorem core_sound : attained M E (core_rank_in M cs n L W).
Proof.
rewrite /attained /core_rank_in; case: M.
- exact: (core_rank_sound the_prime_is_prime the_prime_is_odd cs W lt).
- exact: (@bearing_rank_sound the_prime the_prime_is_prime n 1 in_space cs isT L lt).
- exact: (@bearing_rank_sound the_prime the_prime_is_prime n 0 in_plane cs isT L lt).
Qed.

Theorem core_motion motion (i j : 'I_n) : all_allow M cs motion L -> ~~ allows M cs motion i j ->
  attained M ((i, j) :: E) (core_rank_in M cs n L W).+1.
Proof.
rewrite /attained /core_rank_in /all_allow /allows; case: M => sol no.
- exact: (motion_sound the_prime_is_prime (core_rank_modp the_prime_is_prime the_prime_is_odd cs W lt) sol no).
- have le := @bearing_rank_modp the_prime the_prime_is_prime n 1 in_space cs isT L lt.
  exact: (@bearing_motion_sound the_prime the_prime_is_prime n 1 in_space cs isT in_space_all motion L i j _ le sol no).
- have le := @bearing_rank_modp the_prime the_prime_is_prime n 0 in_plane cs isT L lt.
  exact: (@bearing_motion_sound the_prime the_prime_is_prime n 0 in_plane cs isT in_plane_all motion L i j _ le sol no).
Qed.
End Sound.
