(* What the program needs of a model, and the three models have it: ranks that are attained at some rational cameras or
   points, and ranks that none exceed. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From Viewcert Require Import Statement Skew Motions Generic NormalForm Counting Rigid Directions.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.

(* what a node adds that is joined to one node, to two *)
Definition one M : nat := match M with Projective => 7 | Calibrated => 2 | Affine => 1 end.
Definition two M : nat := match M with Projective => 11 | Calibrated => 3 | Affine => 2 end.

Section Models.
Variables (M : model) (n : nat).
Implicit Types (E T K : seq ('I_n * 'I_n)) (b : seq 'I_n).

(* [rank_at_least] and [rank_at_most] of some pairs of nodes *)
Definition attained E (r : nat) : Prop :=
  match M with Projective => Generic.attained E r | Calibrated => seen 1 E r | Affine => seen 0 E r end.
Definition at_most E (r : nat) : Prop :=
  forall F : numFieldType,
  match M with
  | Projective => forall P : cameras F n, \rank (J E P) <= r
  | Calibrated => forall c : points F n 3, \rank (N E c) <= r
  | Affine => forall c : points F n 2, \rank (N E c) <= r
  end.

Lemma attained_either E1 E2 r : all (either E2) E1 -> attained E1 r -> attained E2 r.
Proof. by rewrite /attained; case: M; [exact: Rigid.attained_either | exact: seen_either | exact: seen_either]. Qed.
Lemma attained_mono E1 E2 r : {subset E1 <= E2} -> attained E1 r -> attained E2 r.
Proof. by rewrite /attained; case: M; [exact: Generic.attained_mono | exact: seen_mono | exact: seen_mono]. Qed.
Lemma attained_less E r s : r <= s -> attained E s -> attained E r.
Proof. by rewrite /attained; case: M => le [P h]; exists P; exact: leq_trans h. Qed.
Lemma attained_zero E : attained E 0.
Proof. by rewrite /attained; case: M; exists 0%R. Qed.

Lemma grow_one (v a : 'I_n) E r : v != a -> all (fun e => (e.1 != v) && (e.2 != v)) E ->
  attained E r -> attained ((v, a) :: E) (r + one M).
Proof. by rewrite /attained /one; case: M; [exact: Rigid.grow_one | exact: seen_one | exact: seen_one]. Qed.
Lemma grow_two (v a b : 'I_n) E r : v != a -> v != b -> a != b -> all (fun e => (e.1 != v) && (e.2 != v)) E ->
  attained E r -> attained ((v, a) :: (v, b) :: E) (r + two M).
Proof. by rewrite /attained /two; case: M; [exact: Rigid.grow_two | exact: seen_two | exact: seen_two]. Qed.

(* a body holds all pairs of its nodes: rule 4 of Theorems 4.1, 4.9 and 13.9 *)
Lemma full E T K b r : 1 < size b -> all (either E) T -> all (inside b) T -> all (inside b) K ->
  attained T (required M (size b)) -> attained (K ++ E) r -> attained E r.
Proof. by rewrite /attained /required; case: M; [exact: theorem_4_1 | exact: rule_4 | exact: rule_4]. Qed.

Lemma at_most_inside b E : 1 < size b -> all (inside b) E -> at_most E (required M (size b)).
Proof.
move=> s1 inb F; case: M => P; [exact: rank_inside | exact: N_inside | exact: N_inside].
Qed.
Lemma at_most_mono E1 E2 r : {subset E1 <= E2} -> at_most E2 r -> at_most E1 r.
Proof.
move=> s h F; have := h F; rewrite /at_most; case: M => {}h P; apply: leq_trans (h P); [exact: J_mono | exact: N_mono | exact: N_mono].
Qed.
Lemma at_most_nil : at_most [::] 0.
Proof. by move=> F; case: M => P; rewrite ?J_nil ?N_nil. Qed.
Lemma at_most_less E r s : r <= s -> at_most E r -> at_most E s.
Proof. by move=> le h F; have := h F; case: M => {}h P; exact: leq_trans (h P) le. Qed.
Lemma at_most_attained E r s : at_most E r -> attained E s -> s <= r.
Proof. by rewrite /attained => h; have := h [numFieldType of rat]; case: M => {}h [P le]; exact: leq_trans le (h P). Qed.

(* Corollary 5.11 *)
Lemma overlap E1 E2 E0 u1 u2 l : {subset E0 <= E1} -> {subset E0 <= E2} -> attained E0 l ->
  at_most E1 u1 -> at_most E2 u2 -> at_most (E1 ++ E2) (u1 + u2 - l).
Proof.
have points d (F : numFieldType) : {subset E0 <= E1} -> {subset E0 <= E2} -> seen d E0 l ->
    (forall c : points F n d.+2, \rank (N E1 c) <= u1) -> (forall c : points F n d.+2, \rank (N E2 c) <= u2) ->
    forall c : points F n d.+2, \rank (N (E1 ++ E2) c) <= u1 + u2 - l.
  move=> s1 s2 [c0 le] h1 h2 c; pose c1 : points F n d.+2 := map_mx (ratr : rat -> F) c0.
  have l1 : l <= \rank (N E0 c1) by rewrite -(map_N (ratr_rmorphism F)) mxrank_map.
  have [c' [r1 r2]] := both_N E0 (E1 ++ E2) c1 c.
  have := leq_trans (leq_add r2 (leq_trans l1 r1)) (leq_trans (N_submodular c' s1 s2) (leq_add (h1 c') (h2 c'))).
  by move: (\rank (N _ c)) => r; lia.
rewrite /attained => s1 s2 + h1 h2 F; have := h1 F; have := h2 F; rewrite /at_most; case: M => {}h2 {}h1 a; first last.
- exact: points.
- exact: points.
case: a => P0 le P; have l1 : l <= \rank (J E0 (map_mx (ratr : rat -> F) P0 : cameras F n)).
  by rewrite -(map_J (ratr_rmorphism F)) mxrank_map.
by have := corollary_5_11 s1 s2 l1 h1 h2 P; lia.
Qed.
Lemma at_most_cat E1 E2 u1 u2 : at_most E1 u1 -> at_most E2 u2 -> at_most (E1 ++ E2) (u1 + u2).
Proof. by move=> h1 h2; rewrite -[_ + _]subn0; apply: (overlap (E0 := [::])) => //; exact: attained_zero. Qed.
End Models.

Lemma attained_moved M n k (s : 'I_k -> 'I_n) E r : injective s -> attained M E r -> attained M (moved s E) r.
Proof. by rewrite /attained; case: M; [exact: Generic.attained_moved | exact: seen_moved | exact: seen_moved]. Qed.

(* ------------------------------------------------------------------ numbers *)
Section Numbers.
Variable M : model.
Lemma required_positive k : 1 < k -> 0 < required M k.
Proof. by rewrite /required; case: M; lia. Qed.
Lemma required_mono i j : 1 < i -> 1 < j -> required M i <= required M j -> i <= j.
Proof. by rewrite /required; case: M; lia. Qed.
(* two parts that cover a third one of full rank share two nodes *)
Lemma two_shared i j k s : 1 < i -> 1 < j -> required M k <= required M i + required M j -> i + j <= s + k -> 1 < s.
Proof. by rewrite /required; case: M; lia. Qed.
Lemma required_more i j k : 1 < k -> required M (j + (i + k)) = required M k + two M * i + two M * j.
Proof. by rewrite /required /two; case: M; lia. Qed.
End Numbers.
