(* Sections 3 and 13: the rank of N modulo p as a program, at given points; and motions that some pairs allow and another
   one does not. Rows are 2 x 2 minors of the displacements of points and motion, columns d v + k. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Generic NormalForm Rigid Directions Elimination.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.

(* ------------------------------------------------------------------ the program *)
Section Program.
Variables (p d : nat) (minors : seq (nat * nat)) (cs : nat -> nat -> nat).

Definition gap i j k := addp p (cs i k) (oppp p (cs j k)).
(* the minor of coordinates g and h *)
Definition minor_row i j (gh : nat * nat) : sparse :=
  [:: (d * i + gh.1, oppp p (gap i j gh.2)); (d * i + gh.2, gap i j gh.1);
      (d * j + gh.1, gap i j gh.2); (d * j + gh.2, oppp p (gap i j gh.1))].

(* bit t of the number with a pair says whether its t-th minor is used *)
Fixpoint minor_rows i j mask (L : seq (nat * nat)) (tail : seq sparse) : seq sparse :=
  if L is gh :: L' then
    let more := minor_rows i j (mask %/ 2) L' tail in
    if eqn (mask %% 2) 0 then more else minor_row i j gh :: more
  else tail.
Fixpoint bearing_rows (L : seq (nat * nat * nat)) : seq sparse :=
  if L is (i, j, mask) :: L' then minor_rows i j mask minors (bearing_rows L') else [::].
Definition bearing_rank k (L : seq (nat * nat * nat)) : nat := size (pivots_of p (d * k) (bearing_rows L)).

(* whether a pair allows a motion *)
Variable motion : nat -> nat.
Fixpoint minors_zero i j (L : seq (nat * nat)) : bool :=
  if L is gh :: L' then if eqn (dot p motion (minor_row i j gh)) 0 then minors_zero i j L' else false else true.
Definition bearing_solved i j : bool := minors_zero i j minors.
Fixpoint bearings_solved (L : seq (nat * nat * nat)) : bool :=
  if L is (i, j, _) :: L' then if bearing_solved i j then bearings_solved L' else false else true.
End Program.

(* ------------------------------------------------------------------ its soundness *)
Local Open Scope ring_scope.
Section Sound.
Variable p : nat.
Hypothesis p_prime : prime p.
Notation Fp := 'F_p.
Variables (n d' : nat) (minors : seq (nat * nat)) (cs : nat -> nat -> nat).
Local Notation d := d'.+2.
Hypothesis minors_in : all (fun gh => (gh.1 < d) && (gh.2 < d))%N minors.
Hypothesis minors_all : forall g h, (g < h)%N -> (h < d)%N -> (g, h) \in minors.
Implicit Types (y : points [comRingType of Fp] n d) (L : seq (nat * nat * nat)) (E : seq ('I_n * 'I_n)).

Definition spots : points [comRingType of Fp] n d := \matrix_(v, k) (cs v k)%:R.

(* a motion as unknowns *)
Definition place_of y (k : nat) : Fp := if insub (k %/ d)%N is Some v then y v (inord (k %% d)) else 0.
Lemma place_at y (v : 'I_n) (h : 'I_d) : place_of y (d * v + h) = y v h.
Proof.
rewrite /place_of mulnC divnMDl // divn_small ?addn0 ?ltn_ord // modnMDl modn_small ?ltn_ord // valK.
by rewrite inord_val.
Qed.
Lemma place_big y k : (d * n <= k)%N -> place_of y k = 0.
Proof. by move=> nk; rewrite /place_of insubF // ltnNge leq_divRL // mulnC nk. Qed.
Lemma place_linear a y z k : place_of (a *: y + z) k = a * place_of y k + place_of z k.
Proof. by rewrite /place_of; case: insub => [v|]; rewrite ?mxE // mulr0 addr0. Qed.
Lemma place_zero y : (forall k, place_of y k = 0) -> y = 0.
Proof. by move=> h; apply/matrixP=> v k; rewrite mxE -place_at h. Qed.

Lemma gapE i j k : (gap p cs i j k)%:R = (cs i k)%:R - (cs j k)%:R :> Fp.
Proof. by rewrite /gap addpE // opppE. Qed.

Lemma minor_sound (i j : 'I_n) (g h : 'I_d) y :
  eval (minor_row p d cs i j (nat_of_ord g, nat_of_ord h)) (place_of y) = turned spots (i, j) y g h.
Proof.
rewrite turnedE /displacement /eval /minor_row !big_cons big_nil /= !opppE // !gapE !place_at !mxE /=.
move: (cs i g)%:R (cs j g)%:R (cs i h)%:R (cs j h)%:R (y i g) (y j g) (y i h) (y j h) => a b u v w x z t.
by ring.
Qed.

Lemma minor_rowsP i j mask M tail r : r \in minor_rows p d cs i j mask M tail -> r \in tail \/
  exists2 gh, gh \in M & r = minor_row p d cs i j gh.
Proof.
elim: M mask => [|gh M ih] mask; first by left.
have more : r \in minor_rows p d cs i j (mask %/ 2) M tail -> r \in tail \/ exists2 x, x \in gh :: M & r = minor_row p d cs i j x.
  by case/ih=> [|[x xM ->]]; [left | right; exists x; rewrite // inE xM orbT].
rewrite [minor_rows _ _ _ _ _ _ _ _]/=; case: ifP => // _; rewrite inE => /predU1P [->|//].
by right; exists gh => //; exact: mem_head.
Qed.

Arguments minor_rows : simpl never.
Lemma bearing_rowsP L r : r \in bearing_rows p d minors cs L -> exists2 e, e \in L & exists2 gh, gh \in minors &
  r = minor_row p d cs e.1.1 e.1.2 gh.
Proof.
elim: L => [|[[i j] mask] L ih] //; rewrite [bearing_rows _ _ _ _ _]/=; move=> /minor_rowsP [/ih [e eL h] | [gh ghM ->]].
  by exists e; rewrite // inE eL orbT.
by exists (i, j, mask); [exact: mem_head | exists gh].
Qed.

(* some unknowns, as linear forms *)
Definition chosen (ks : seq nat) (u : 'rV[Fp]_(n * d)) : 'rV[Fp]_(size ks) := \row_k place_of (vec_mx u) (nth 0%N ks k).
Lemma chosen_is_linear ks : linear (chosen ks).
Proof. by move=> a u v; apply/rowP=> k; rewrite !mxE linearP /= place_linear. Qed.

Theorem bearing_rank_modp L : all (fun e => (e.1.1 < n) && (e.1.2 < n))%N L ->
  (bearing_rank p d minors cs n L <= \rank (N (edges n (pairs_of L)) spots))%N.
Proof.
move=> /allP lt; rewrite /bearing_rank; set Y := bearing_rows _ _ _ _ _; set A := N _ _.
have sz := size_free p (d * n) Y; set ks := free _ _ in sz.
suff le : (n * d <= \rank A + size ks)%N by rewrite -(leq_add2r (size ks)) sz [(d * n)%N]mulnC.
apply: (rank_by_coordinates (C := lin1_mx (Linear (chosen_is_linear ks)))) => u /eqP; rewrite N_ker => /allP uA.
rewrite mul_rV_lin1 /= => /rowP u0.
suff v0 : vec_mx u = 0 :> points _ n d by rewrite -[u]vec_mxK v0 linear0.
apply: place_zero; apply: (pivots_sound p_prime (N := d * n) (Y := Y)) => [r|k|k kf].
- move=> /bearing_rowsP [[[i j] mask] eL [[g h] ghM ->]]; have /andP [/= iN jN] := lt _ eL.
  have /andP [/= gd hd] := allP minors_in _ ghM.
  rewrite (minor_sound (Ordinal iN) (Ordinal jN) (Ordinal gd) (Ordinal hd)).
  have /uA /eqP -> : (Ordinal iN, Ordinal jN) \in edges n (pairs_of L) by apply/edges_mem/(map_f fst eL).
  by rewrite mxE.
- exact: place_big.
- have li : (index k ks < size ks)%N by rewrite index_mem.
  by have := u0 (Ordinal li); rewrite !mxE /= nth_index.
Qed.

(* Proposition 1.4, Lemma 3.6 *)
Lemma seen_modp E r : (r <= \rank (N E spots))%N -> seen d' E r.
Proof.
move=> h; pose cZ : 'M[int]_(n, d) := \matrix_(v, k) (cs v k)%:Z.
exists (map_mx intr cZ); apply: leq_trans h _.
have -> : spots = map_mx intr cZ by apply/matrixP=> v k; rewrite !mxE.
rewrite -(map_N (intmul1_rmorphism [comRingType of Fp])) -(map_N (intmul1_rmorphism rat_comRing)).
exact: proposition_1_4.
Qed.

Theorem bearing_rank_sound L : all (fun e => (e.1.1 < n) && (e.1.2 < n))%N L ->
  seen d' (edges n (pairs_of L)) (bearing_rank p d minors cs n L).
Proof. by move/bearing_rank_modp/seen_modp. Qed.

(* A motion in numbers that all these pairs allow, and the pair of i and j does not: that pair raises the rank. *)
Section Motion.
Variable motion : nat -> nat.
Definition motion_y : points [comRingType of Fp] n d := \matrix_(v, h) (motion (d * v + h))%:R.

Lemma dot_minor (i j : 'I_n) (g h : 'I_d) :
  (dot p motion (minor_row p d cs i j (nat_of_ord g, nat_of_ord h)))%:R = turned spots (i, j) motion_y g h.
Proof.
rewrite -minor_sound /minor_row /eval !big_cons big_nil /=.
have e (v : 'I_n) (k : 'I_d) : place_of motion_y (d * v + k) = (motion (d * v + k))%:R by rewrite place_at mxE.
by rewrite !e !gapE !addpE // !mulpE // !gapE.
Qed.

Lemma bearing_solvedP (i j : 'I_n) : bearing_solved p d minors cs motion i j = (turned spots (i, j) motion_y == 0).
Proof.
have zero (g h : 'I_d) : eqn (dot p motion (minor_row p d cs i j (nat_of_ord g, nat_of_ord h))) 0 = (turned spots (i, j) motion_y g h == 0).
  rewrite -dot_minor -(dvdn_charf (char_Fp p_prime)); set r := minor_row _ _ _ _ _ _.
  by have := dot_lt p_prime motion r; case: dot => [|x] lt; rewrite ?dvdn0 // gtnNdvd.
have all_gh : bearing_solved p d minors cs motion i j
    = all (fun gh => turned spots (i, j) motion_y (inord gh.1) (inord gh.2) == 0) minors.
  rewrite /bearing_solved; move: minors_in; elim: {1 2 3}minors => //= -[g h] M ih /andP [/andP [/= gd hd] /ih <-].
  by have := zero (Ordinal gd) (Ordinal hd) => /= ->; rewrite -(inord_val (Ordinal gd)) -(inord_val (Ordinal hd)) /=; case: eqP.
rewrite all_gh; apply/allP/eqP => [h | -> gh _]; last by rewrite mxE.
apply/matrixP=> a b; rewrite [RHS]mxE.
wlog ab : a b / (a < b)%N.
  move=> w; case: (ltngtP a b) => [|ba|/val_inj ->]; [exact: w | | by rewrite turnedE mulrC subrr].
  by have := w b a ba; rewrite !turnedE => e; apply/eqP; rewrite -oppr_eq0 opprB mulrC [X in _ - X]mulrC e.
by have /eqP := h _ (minors_all ab (ltn_ord b)); rewrite /= !inord_val.
Qed.

Theorem bearing_motion_sound L (i j : 'I_n) r : (r <= \rank (N (edges n (pairs_of L)) spots))%N ->
  bearings_solved p d minors cs motion L -> ~~ bearing_solved p d minors cs motion i j ->
  seen d' ((i, j) :: edges n (pairs_of L)) r.+1.
Proof.
move=> rL sol nij; apply: seen_modp; apply: leq_ltn_trans rL _.
set E := edges n _; rewrite bearing_solvedP in nij.
have EP : {subset E <= (i, j) :: E} by move=> e eE; rewrite inE eE orbT.
have sub := N_ker_mono spots EP.
have uE : (mxvec motion_y <= kermx (N E spots))%MS.
  rewrite N_kerP mxvecK; apply/allP=> -[x y]; rewrite mem_pmap => /mapP [[x' y'] /mapP [[[k l] mask] kL [-> ->]] /=].
  case: insubP => // x'' _ ex; case: insubP => // y'' _ ey [-> ->]; rewrite -bearing_solvedP ex ey.
  elim: L sol kL {E EP sub} => //= -[[k' l'] mask'] L ih; case: ifP => // kl /ih {}ih.
  by rewrite inE => /predU1P [[-> -> _]|/ih].
have nuE : ~~ (mxvec motion_y <= kermx (N ((i, j) :: E) spots))%MS.
  by rewrite N_kerP mxvecK /= (negbTE nij).
have /rank_ltmx : (kermx (N ((i, j) :: E) spots) < kermx (N E spots))%MS.
  by rewrite ltmxE sub /=; apply: contra nuE; apply: submx_trans.
by rewrite !mxrank_ker; move: (\rank _) (\rank _) => r1 r2; lia.
Qed.
End Motion.
End Sound.
