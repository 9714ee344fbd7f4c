(* Is Statement.v about what it should be about? What a sceptic may want to see before he believes it. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Generic Counting Rigid Checker.
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

Theorem turned (R : comRingType) n (P dP : cameras R n) i j : equation P (j, i) dP = equation P (i, j) dP.
Proof. exact: equation_swap. Qed.

Theorem loop (R : comRingType) (A : 'M[R]_(3, 4)) : fund A A = 0.
Proof. exact: fund_loop. Qed.

(* There is at most one generic rank, and full rank is the largest there can be. *)
Theorem one_rank n G r s : generic_rank n G r -> generic_rank n G s -> r = s.
Proof.
move=> [_ [P1 a1] b1] [_ [P2 a2] b2]; apply/eqP; rewrite eqn_leq.
by rewrite (leq_trans a1 (b2 _ _)) // (leq_trans a2 (b1 _ _)).
Qed.

Theorem largest n G r : generic_rank n G r -> (r <= 11 * n - 15)%N.
Proof. by case=> /and3P [n1 _ _] [P a] _; apply: leq_trans a (lemma_1_1 _ _ n1). Qed.

Local Close Scope ring_scope.

(* A graph of full rank is one component. *)
Theorem full_rank_component n G : full_rank n G -> components n G [:: iota 0 n].
Proof.
case=> /and3P [n1 /allP lt _] low _.
have in_iota x : (x \in iota 0 n) = (x < n) by rewrite mem_iota.
have whole : part n G (iota 0 n).
  split; rewrite ?size_iota ?iota_uniq //; first by apply/allP=> x; rewrite in_iota.
  suff -> : within (iota 0 n) G = G by [].
  by apply/all_filterP/allP=> e /lt /andP [e12 en]; rewrite !in_iota en (ltn_trans e12 en).
have sub b : part n G b -> {subset b <= iota 0 n} by case=> _ _ /allP bn _ x /bn; rewrite in_iota.
split=> [b | b [pb maxb]]; first by rewrite inE => /eqP ->; split=> // b' /sub.
by exists (iota 0 n); rewrite ?mem_head // => x; apply/idP/idP=> [/(maxb _ whole (sub _ pb))|/(sub _ pb)].
Qed.

(* Small graphs, as the program checks them: a pair and a triangle have full rank, a 4-cycle has not. *)
Definition at_ (s : seq (nat * nat)) k := nth (0%N, 0%N) s k.
Definition chain (k : nat) (joins : nat -> seq (nat * reason)) (_ : nat) : body :=
  Body k id id 0 [::] (fun _ _ => 0%N) joins.
Definition no_block (_ : nat) : block := Block 0 id.
Definition nothing : body := chain 0 (fun _ => [::]) 0.

Theorem pair : full_rank 2 [:: (0, 1)]%N.
Proof.
apply: (has_full_rank (u := 7)); pose G := [:: (0, 1)]%N.
have := @verify_sound 2 1 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id
  (chain 2 (fun s => nth [::] [:: [::]; [:: (0, Pair 0)]] s)) id 0 7 no_block 0 nothing 0 (fun _ => None) 7.
by apply; vm_compute.
Qed.

Theorem one_pair_has_rank_7 : generic_rank 2 [:: (0, 1)]%N 7.
Proof. exact: pair. Qed.

Theorem triangle : full_rank 3 [:: (0, 1); (0, 2); (1, 2)]%N.
Proof.
apply: (has_full_rank (u := 18)); pose G := [:: (0, 1); (0, 2); (1, 2)]%N.
have := @verify_sound 3 3 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id
  (chain 3 (fun s => nth [::] [:: [::]; [:: (0, Pair 0)]; [:: (0, Pair 1); (1, Pair 2)]] s)) id 0 18
  no_block 0 nothing 0 (fun _ => None) 18.
by apply; vm_compute.
Qed.

Theorem four_cycle : ~ full_rank 4 [:: (0, 1); (0, 3); (1, 2); (2, 3)]%N.
Proof.
apply: (@lacks_full_rank 4 _ 0 28) => //; pose G := [:: (0, 1); (0, 3); (1, 2); (2, 3)]%N.
have := @verify_sound 4 4 (fun k => (at_ G k).1) (fun k => (at_ G k).2) id
  (chain 0 (fun _ => [::])) id 0 0 no_block 0 nothing 0 (fun _ => None) 28.
by apply; vm_compute.
Qed.
