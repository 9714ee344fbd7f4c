(* Is Statement.v about what it should be about? What a sceptic may want to see before he believes it. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Differential Generic NormalForm Counting Rigid Directions Models Checker Generically Parallel Unique Solvable.
From Viewcert Require Scales.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.
Local Open Scope ring_scope.

(* [fund] is a fundamental matrix: the images A X and B X of a point satisfy the epipolar constraint. *)
Theorem epipolar (F : numFieldType) (A B : 'M[F]_(3, 4)) (X : 'cV[F]_4) :
  (B *m X)^T *m fund A B *m (A *m X) = 0.
Proof.
have sk := skew A B; cbv zeta in sk; move: (fund A B) sk => G sk.
have -> : (B *m X)^T *m G *m (A *m X) = X^T *m (B^T *m G *m A) *m X by rewrite trmx_mul !mulmxA.
move: (B^T *m G *m A) sk => S sk; set x := X^T *m S *m X.
have tx : x^T = - x by rewrite /x !trmx_mul trmxK sk mulNmx mulmxN mulmxA.
have x1 : x^T = x by rewrite [x]mx11_scalar tr_scalar_mx.
apply/matrixP=> i j; have := congr1 (fun y : 'M_1 => y i j) tx; rewrite x1 !mxE.
by move/eqP; rewrite -addr_eq0 -mulr2n mulrn_eq0 /= => /eqP.
Qed.

(* J_P is the derivative at P of Q |-> S + S^T, S = Q_j^T F Q_i, with F = F(P) held fixed; at P this is zero. *)
Definition Phi (R : comRingType) n (F : 'M[R]_3) (e : 'I_n * 'I_n) (Q : cameras R n) : 'M[R]_4 :=
  let S := (cam Q e.2)^T *m F *m cam Q e.1 in S + S^T.

Theorem Phi_at_P (R : comRingType) n (P : cameras R n) e : Phi (fund (cam P e.1) (cam P e.2)) e P = 0.
Proof. by have sk := skew (cam P e.1) (cam P e.2); rewrite /Phi; cbv zeta in sk; rewrite sk addrN. Qed.

Theorem derivative (R : comRingType) n (P dP : cameras R n) e : let F := fund (cam P e.1) (cam P e.2) in
  Phi F e (dP + P) = equation P e dP + Phi F e dP.
Proof.
move=> G; rewrite -[RHS]addr0 -(Phi_at_P P e) -/G /equation -/G /Phi.
have cD v : cam (dP + P) v = cam dP v + cam P v by rewrite -[dP]scale1r camP !scale1r.
rewrite !cD; move: (cam P e.1) (cam P e.2) (cam dP e.1) (cam dP e.2) G => A B a b G.
have tr (Y Z : 'M[R]_4) : (Y + Z)^T = Y^T + Z^T by rewrite linearD.
have -> : A^T *m G^T *m b = (b^T *m G *m A)^T by rewrite !trmx_mul trmxK mulmxA.
have -> : (b + B)^T = b^T + B^T by rewrite linearD.
rewrite !(mulmxDl, mulmxDr) !tr !trmxK.
move: (b^T *m G *m a) (b^T *m G *m A) (B^T *m G *m a) (B^T *m G *m A) => p q r s.
apply/matrixP=> i j; rewrite !mxE.
by move: (p i j) (p j i) (q i j) (q j i) (r i j) (r j i) (s i j) (s j i) => *; ring.
Qed.

(* The kernel of J_P is (1.2). *)
Theorem kernel (F : fieldType) n (E : seq ('I_n * 'I_n)) (P : cameras F n) (u : 'rV_(n * (3 * 4))) :
  (u <= kermx (J E P))%MS = all (fun e => equation P e (vec_mx u) == 0) E.
Proof. exact: J_kerP. Qed.

(* [edges] leaves out no pair of a well-formed graph. *)
Theorem edges_all n G : well_formed n G -> [seq (val e.1, val e.2) | e <- edges n G] = G.
Proof.
case/and3P=> _ /allP lt _; elim: G lt => //= -[a b] G ih lt.
have /andP [/= ab bn] := lt _ (mem_head _ _).
rewrite /edges /= insubT /=; first exact: ltn_trans bn.
move=> an; rewrite insubT //= -/(edges n G) ih // => e eG; apply: lt.
by rewrite inE eG orbT.
Qed.

(* The rank depends on the set of pairs, whichever way round they are; a loop would count for nothing. *)
Theorem rank_of_set (F : fieldType) n (E1 E2 : seq ('I_n * 'I_n)) (P : cameras F n) :
  E1 =i E2 -> \rank (J E1 P) = \rank (J E2 P).
Proof. by move=> e; apply/eqP; rewrite eqn_leq !J_mono // => x; rewrite e. Qed.

Theorem either_way (R : comRingType) n (P dP : cameras R n) i j : equation P (j, i) dP = equation P (i, j) dP.
Proof. exact: equation_swap. Qed.

Theorem loop (R : comRingType) (A : 'M[R]_(3, 4)) : fund A A = 0.
Proof. exact: fund_loop. Qed.

(* There is at most one generic rank, and full rank is the largest there can be. *)
Theorem one_rank M n G r s : generic_rank M n G r -> generic_rank M n G s -> r = s.
Proof.
move=> [_ a1 b1] [_ a2 b2]; apply/eqP; rewrite eqn_leq.
by rewrite (@at_most_attained M n (edges n G) _ _ b2 a1) (@at_most_attained M n (edges n G) _ _ b1 a2).
Qed.

Theorem largest M n G r : generic_rank M n G r -> (r <= required M n)%N.
Proof. by case=> good a _; exact: (at_most_attained (at_most_all M good) a). Qed.

(* There is one. Natural numbers suffice as entries of cameras, whatever the field, *)
Lemma on_line (F : numFieldType) n E (P D : cameras F n) (c : F) :
  exists k : nat, (\rank (J E P) <= \rank (J E (P + (k%:R - c) *: D)%R))%N.
Proof.
have [Q [n1 h]] := rank_open (J E (line P (P + D))) 0.
have n2 : Q \Po ('X - c%:P) != 0 by rewrite comp_poly_eq0 // size_XsubC.
have [k hk] := nonroot n2; exists k; move: hk; rewrite horner_comp !hornerE => /h.
by rewrite !map_J !ev_line scale0r addr0 [P + D]addrC addrK.
Qed.

Theorem natural_cameras (F : numFieldType) n E (P : cameras F n) :
  exists Z : 'M[nat]_(n, 3 * 4), (\rank (J E P) <= \rank (J E (map_mx (fun k => k%:R : F) Z)))%N.
Proof.
suff : forall s : seq ('I_n * 'I_(3 * 4)), exists Q : cameras F n, (\rank (J E P) <= \rank (J E Q))%N
    /\ forall x, x \in s -> exists k : nat, Q x.1 x.2 = k%:R.
  case/(_ (enum {: 'I_n * 'I_(3 * 4)})) => Q [le h].
  have h' i j : exists k : nat, Q i j == k%:R.
    by have [|k e] := h (i, j); [rewrite mem_enum | exists k; apply/eqP].
  exists (\matrix_(i, j) xchoose (h' i j)).
  suff -> : map_mx (fun k => k%:R : F) (\matrix_(i, j) xchoose (h' i j)) = Q by [].
  by apply/matrixP=> i j; rewrite !mxE -(eqP (xchooseP (h' i j))).
elim=> [|[i j] s [Q [le h]]]; first by exists P.
have [k hk] := on_line E Q (delta_mx i j) (Q i j).
exists (Q + (k%:R - Q i j) *: delta_mx i j)%R; split; first exact: leq_trans hk.
move=> [a b]; rewrite !mxE /=; case: (boolP ((a, b) == (i, j))) => [/eqP [-> ->] _|ne].
  by exists k; rewrite !eqxx mulr1 addrC subrK.
rewrite inE (negbTE ne) /= => /h /= [l e]; exists l.
have -> : (a == i) && (b == j) = false by apply: negbTE; rewrite -xpair_eqE.
by rewrite mulr0 addr0.
Qed.

(* so no field has larger ranks than the rationals, *)
Theorem rational_cameras (F : numFieldType) n E (P : cameras F n) :
  exists Q : cameras rat_comRing n, (\rank (J E P) <= \rank (J E Q : 'M[rat]_(_, _)))%N.
Proof.
have [Z le] := natural_cameras E P; pose Q : cameras rat_comRing n := map_mx (fun k => k%:R : rat) Z; exists Q.
have e : map_mx (fun k => k%:R : F) Z = map_mx (ratr : rat -> F) Q by apply/matrixP=> i j; rewrite !mxE rmorph_nat.
by move: le; rewrite e -(map_J (ratr_rmorphism F)) mxrank_map.
Qed.

(* and it cannot be that no number is the generic rank. (Which one it is takes a search; no axiom is used here.) *)
Theorem a_rank n G : well_formed n G -> ~ (forall r, ~ generic_rank Projective n G r).
Proof.
move=> good none; have n1 : (1 < n)%N by case/and3P: good.
suff no d r : (r + d)%N = (11 * n - 15)%N -> ~ rank_at_least Projective n G r by apply: (no (11 * n - 15)%N 0%N); [| exists 0].
elim: d r => [|d ih] r e low; apply: (none r); split=> // F P.
  by rewrite -[r]addn0 e; exact: lemma_1_1.
rewrite leqNgt; apply/negP=> more; have [Q le] := rational_cameras (edges n G) P.
by apply: (ih r.+1); [rewrite addSnnS | exists Q; exact: leq_trans more le].
Qed.

(* The graph with its nodes renamed has the same ranks. *)
Theorem renamed (F : fieldType) n (s : 'I_n -> 'I_n) E (P : cameras F n) : injective s ->
  \rank (J (moved s E) (place F s *m P)) = \rank (J E P).
Proof.
move=> i; apply/eqP; rewrite eqn_leq J_place // andbT; apply: leq_trans (J_local s E _) _.
suff -> : rowsub s (place F s *m P) = P by [].
apply/row_matrixP=> v; rewrite row_rowsub -[LHS]vec_mxK -[RHS]vec_mxK; congr mxvec.
exact: cam_place.
Qed.

(* Full rank means that, at some cameras, the trivial motions of Lemma 1.1 are the only ones. *)
Lemma rank_T (F : numFieldType) n (P : cameras F n) : (\rank (T P) <= n + 15)%N.
Proof.
have k : (row_mx (mxvec (1%:M : 'M_4)) (const_mx (-1) : 'rV_n) <= kermx (T P))%MS.
  apply/sub_kermxP; rewrite mul_rV_lin1 /= /trivial_fun row_mxKl row_mxKr mxvecK.
  apply/eqP; rewrite mxvec_eq0; apply/eqP/row_matrixP=> v; rewrite rowK row0 mulmx1 mxE scaleN1r subrr.
  by rewrite linear0.
have n0 : row_mx (mxvec (1%:M : 'M_4)) (const_mx (-1) : 'rV_n) != 0 :> 'rV[F]_(4 * 4 + n).
  apply/eqP=> /(congr1 lsubmx); rewrite row_mxKl linear0 => /eqP; rewrite mxvec_eq0 => /eqP/matrixP/(_ ord0 ord0).
  by rewrite !mxE /= => /eqP; rewrite oner_eq0.
have := mxrankS k; rewrite rank_rV n0 mxrank_ker; have := rank_leq_row (T P); lia.
Qed.

Theorem only_trivial_motions n G : well_formed n G ->
  full_rank Projective n G <-> exists P : cameras rat_comRing n, (kermx (J (edges n G) P : 'M[rat]_(_, _)) == T P)%MS.
Proof.
move=> good; have n1 : (1 < n)%N by case/and3P: good.
have TJ (P : cameras rat_comRing n) : (T P <= kermx (J (edges n G) P : 'M[rat]_(_, _)))%MS by apply/sub_kermxP; exact: T_J.
split=> [[_ [P0 low] _] | [P /eqmxP ker]]; last first.
  split=> // [|F Q]; last exact: lemma_1_1.
  exists P; have := rank_T (P : cameras [numFieldType of rat] n); rewrite -ker mxrank_ker.
  have := rank_leq_row (J (edges n G) P : 'M[rat]_(_, _)); rewrite /required; lia.
case: n n1 G good P0 low TJ => [|[|n]] // _ G good P0 low TJ.
have [||P [r1 r2]] := @Generic.both [numFieldType of rat] _ _ _ _ _ _ (fun R U => T U) (fun R U => J (edges _ G) U) (@Generic.good [numFieldType of rat] n) P0.
- by move=> t; rewrite map_T.
- by move=> t; rewrite map_J.
exists P; rewrite andbC -(geq_leqif (mxrank_leqif_eq (TJ P))) mxrank_ker.
apply: leq_trans (leq_trans (@rank_good [numFieldType of rat] n) r1).
rewrite leq_subLR; apply: leq_trans (leq_add (leq_trans low r2) (leqnn _)).
by clear; rewrite /required; lia.
Qed.

Local Close Scope ring_scope.

(* A graph of full rank is one component. *)
Theorem full_rank_component M n G : full_rank M n G -> components M n G [:: iota 0 n].
Proof.
case=> /and3P [n1 /allP lt _] low _.
have in_iota x : (x \in iota 0 n) = (x < n) by rewrite mem_iota.
have whole : part M n G (iota 0 n).
  split; rewrite ?size_iota ?iota_uniq //; first by apply/allP=> x; rewrite in_iota.
  suff -> : within (iota 0 n) G = G by [].
  by apply/all_filterP/allP=> e /lt /andP [e12 en]; rewrite !in_iota en (ltn_trans e12 en).
have sub b : part M n G b -> {subset b <= iota 0 n} by case=> _ _ /allP bn _ x /bn; rewrite in_iota.
split=> [b | b [pb maxb]]; first by rewrite inE => /eqP ->; split=> // b' /sub.
by exists (iota 0 n); rewrite ?mem_head // => x; apply/idP/idP=> [/(maxb _ whole (sub _ pb))|/(sub _ pb)].
Qed.

(* Small graphs, as the program checks them: a pair and a triangle have full rank, a 4-cycle has not. *)
Definition at_ (s : seq (nat * nat)) k := nth (0%N, 0%N) s k.
Definition chain (k : nat) (joins : nat -> seq (nat * reason)) (_ : nat) : body :=
  Body k id id 0 [::] (fun _ _ => 0%N) [::] joins.
Definition no_block (_ : nat) : block := Block 0 id None.
Definition nothing : body := chain 0 (fun _ => [::]) 0.

Theorem pair : full_rank Projective 2 [:: (0, 1)]%N.
Proof.
apply: (has_full_rank (u := 7)); pose G := [:: (0, 1)]%N.
have := @verify_sound Projective 2 1 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id
  (chain 2 (fun s => nth [::] [:: [::]; [:: (0, Pair 0)]] s)) id 0 7 no_block 0 nothing 0 (fun _ => None) 7.
by apply; vm_compute.
Qed.

Theorem one_pair_has_rank_7 : generic_rank Projective 2 [:: (0, 1)]%N 7.
Proof. exact: pair. Qed.

Theorem triangle : full_rank Projective 3 [:: (0, 1); (0, 2); (1, 2)]%N.
Proof.
apply: (has_full_rank (u := 18)); pose G := [:: (0, 1); (0, 2); (1, 2)]%N.
have := @verify_sound Projective 3 3 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id
  (chain 3 (fun s => nth [::] [:: [::]; [:: (0, Pair 0)]; [:: (0, Pair 1); (1, Pair 2)]] s)) id 0 18
  no_block 0 nothing 0 (fun _ => None) 18.
by apply; vm_compute.
Qed.

Theorem four_cycle : ~ full_rank Projective 4 [:: (0, 1); (0, 3); (1, 2); (2, 3)]%N.
Proof.
apply: (@lacks_full_rank Projective 4 _ 0 28) => //; pose G := [:: (0, 1); (0, 3); (1, 2); (2, 3)]%N.
have := @verify_sound Projective 4 4 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id
  (chain 0 (fun _ => [::])) id 0 0 no_block 0 nothing 0 (fun _ => None) 28.
by apply; vm_compute.
Qed.

(* N: its kernel; where displacements are not zero, it asks that those of a motion are multiples of them. *)
Theorem N_kernel (F : fieldType) n d (E : seq ('I_n * 'I_n)) (c : points F n d) (u : 'rV_(n * d)) :
  (u <= kermx (N E c))%MS = all (fun e => turned c e (vec_mx u) == 0%R) E.
Proof. exact: N_kerP. Qed.
Theorem parallel (F : fieldType) n d (c y : points F n d) e : displacement c e != 0%R ->
  turned c e y = 0%R <-> exists s, displacement y e = (s *: displacement c e)%R.
Proof. by move=> ce; split=> [/(turned_zero ce) | [s]]; [| exact: turned_multiple]. Qed.

(* Directions determine a triangle in space and in a plane. A 5-cycle is not determined in space, nor a 4-cycle in a
   plane, nor two points by nothing. *)
Theorem triangle_determined : directions_determine 3 3 [:: (0, 1); (0, 2); (1, 2)]%N /\ directions_determine 2 3 [:: (0, 1); (0, 2); (1, 2)]%N.
Proof.
pose G := [:: (0, 1); (0, 2); (1, 2)]%N; pose bodies := chain 3 (fun s => nth [::] [:: [::]; [:: (0, Pair 0)]; [:: (0, Pair 1); (1, Pair 2)]] s).
have h M := @verify_sound M 3 3 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id bodies id 0 (required M 3)
  no_block 0 nothing 0 (fun _ => None) (required M 3).
have good : well_formed 3 G by [].
split; [apply/(calibrated_determined good) | apply/(affine_determined good)].
  by apply: (h Calibrated); vm_compute.
by apply: (h Affine); vm_compute.
Qed.

Lemma undetermined M n G u : u < required M n -> well_formed n G -> rank_at_most M n G u -> ~ full_rank M n G.
Proof. by move=> lt good up; apply: (lacks_full_rank (l := 0) lt); split=> //; exact: (@attained_zero M n (edges n G)). Qed.
Theorem five_cycle_undetermined : ~ directions_determine 3 5 [:: (0, 1); (0, 4); (1, 2); (2, 3); (3, 4)]%N.
Proof.
pose G := [:: (0, 1); (0, 4); (1, 2); (2, 3); (3, 4)]%N; have good : well_formed 5 G by [].
move/(calibrated_determined good); apply: (undetermined (u := 10)) => //.
have := @verify_sound Calibrated 5 5 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id
  (chain 0 (fun _ => [::])) id 0 0 no_block 0 nothing 0 (fun _ => None) 10.
by case=> //; vm_compute.
Qed.
Theorem four_cycle_undetermined : ~ directions_determine 2 4 [:: (0, 1); (0, 3); (1, 2); (2, 3)]%N.
Proof.
pose G := [:: (0, 1); (0, 3); (1, 2); (2, 3)]%N; have good : well_formed 4 G by [].
move/(affine_determined good); apply: (undetermined (u := 4)) => //.
have := @verify_sound Affine 4 4 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id
  (chain 0 (fun _ => [::])) id 0 0 no_block 0 nothing 0 (fun _ => None) 4.
by case=> //; vm_compute.
Qed.
Theorem no_pair_undetermined : ~ directions_determine 3 2 [::].
Proof.
have good : well_formed 2 [::] by []; move/(calibrated_determined good); exact: (undetermined (u := 0)).
Qed.

(* A triangle is solvable, as the program checks it; two nodes without a pair are not. *)
Definition no_scales (_ : nat) : scales := Scales (fun _ _ => 0) (fun _ => Scales.Link 0 0 (Scales.Middle 0 (Pair 0) (Pair 0))) [::].
Theorem triangle_solvable : solvable 3 [:: (0, 1); (0, 2); (1, 2)]%N.
Proof.
pose G := [:: (0, 1); (0, 2); (1, 2)]%N.
have := @verify_solvable 3 3 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id
  (fun _ => chain 3 (fun s => nth [::] [:: [::]; [:: (0, Pair 0)]; [:: (0, Pair 1); (1, Pair 2)]] s) 0) (fun _ => true) no_scales 0.
by apply; vm_compute.
Qed.

Theorem no_pair_unsolvable : ~ solvable 2 [::].
Proof.
move=> [_ sol]; have [q [P nz] both] := generically_and sol (@generic_cameras 2).
have [det [_ funds _]] := both [numFieldType of rat] P nz.
pose Q := normal 2 (fun _ _ => 0%R) : cameras rat_comRing 2.
have [|e|H unitH h] := det Q; [by move=> v; apply/eqP; exact: normal_free | by [] |].
pose i : 'I_2 := ord0; pose j : 'I_2 := lift ord0 ord0.
have [t t0 ei] := h i (mem_enum _ _); have [u u0 ej] := h j (mem_enum _ _).
have := funds i j isT; set A := cam P i; set B := cam P j => r2.
have : fund A B != 0%R by rewrite -mxrank_eq0 -lt0n ltnW.
move/distinct; have same : (t *: (A *m H) = u *: (B *m H))%R by rewrite -ei -ej !cam_normal; apply/matrixP=> a b; rewrite !mxE.
have AB : (A <= B)%MS.
  have -> : A = ((t^-1 * u) *: B)%R; last exact: scalemx_sub.
  rewrite -[LHS](mulmxK unitH) -[RHS](mulmxK unitH) -scalemxAl -[(A *m H)%R]scale1r -(mulVf t0) -scalerA same.
  by rewrite scalerA -scalemxAl.
have le : (A + B <= B)%MS by rewrite addsmx_sub AB submx_refl.
by move=> r4; have := leq_trans (mxrankS le) (rank_leq_row B); rewrite r4.
Qed.
