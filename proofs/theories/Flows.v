(* Section 3: plane flows. N is a quarter as wide as J_P, and what it leaves of J_P is Lambda: so large cores have
   their rank by Corollary 3.3.

   The first coordinates of two centres that are joined differ here, so q of (3.1) is the first one: the directions of
   an edge are, up to sign, the rows 1 and 2 of its matrix F (numbered from 0). *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Generic NormalForm Rigid Elimination.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.

(* ------------------------------------------------------------------ the program *)
Section Program.
Variables (p : nat) (cs : nat -> nat -> nat).
Notation addp := (addp p).
Notation mulp := (mulp p).
Notation oppp := (oppp p).

(* a flow: two numbers for each of some edges, the weights of the two directions *)
Definition flow := seq (nat * nat).

Definition direction i j h c := F_entry 0 addp oppp (cs i) (cs j) h c.
(* omega of an edge; the planes of (3.2) in coordinate k *)
Definition omega i j (w : nat * nat) c := addp (mulp w.1 (direction i j 1 c)) (mulp w.2 (direction i j 2 c)).
Definition plane i j (w : nat * nat) k :=
  if k < 3 then omega i j w k
  else oppp (addp (mulp (omega i j w 0) (cs j 0)) (addp (mulp (omega i j w 1) (cs j 1)) (mulp (omega i j w 2) (cs j 2)))).

(* a at node i and -a at node j: a row of N, with columns 3 v + c *)
Definition line i j (a : nat -> nat) : sparse :=
  [:: (3 * i, a 0); (3 * i + 1, a 1); (3 * i + 2, a 2);
      (3 * j, oppp (a 0)); (3 * j + 1, oppp (a 1)); (3 * j + 2, oppp (a 2))].

(* The first two bits of the number with an edge say which rows of N are used, the third one whether its column of Lambda is. *)
Fixpoint N_rows (L : seq (nat * nat * nat)) : seq sparse :=
  if L is (i, j, mask) :: L' then
    let more := N_rows L' in
    let more := if eqn (mask %/ 2 %% 2) 0 then more else line i j (direction i j 2) :: more in
    if eqn (mask %% 2) 0 then more else line i j (direction i j 1) :: more
  else [::].
Definition has_column (e : nat * nat * nat) := if eqn (e.2 %/ 4 %% 2) 0 then false else true.
Fixpoint lambda_row k e (L : seq (nat * nat * nat)) (w : flow) : sparse :=
  match L, w with
  | (i, j, mask) :: L', x :: w' =>
    if has_column (i, j, mask) then (e, plane i j x k) :: lambda_row k e.+1 L' w' else lambda_row k e L' w'
  | _, _ => [::]
  end.
Fixpoint lambda_rows (L : seq (nat * nat * nat)) (W : seq flow) : seq sparse :=
  if W is w :: W' then
    lambda_row 0 0 L w :: lambda_row 1 0 L w :: lambda_row 2 0 L w :: lambda_row 3 0 L w :: lambda_rows L W'
  else [::].

(* w^T N = 0: the sum of the lines is zero, two by two *)
Fixpoint lines (L : seq (nat * nat * nat)) (w : flow) : seq sparse :=
  match L, w with
  | (i, j, _) :: L', x :: w' => sorted_row p (line i j (omega i j x)) :: lines L' w'
  | _, _ => [::]
  end.
Fixpoint two_by_two (Y : seq sparse) : seq sparse :=
  if Y is y1 :: Y1 then if Y1 is y2 :: Y2 then axpy p 1 y1 y2 :: two_by_two Y2 else Y else Y.
Fixpoint zeros (y : sparse) : bool := if y is (_, x) :: y' then if eqn x 0 then zeros y' else false else true.
Fixpoint sum_is_zero fuel (Y : seq sparse) : bool :=
  if fuel is f.+1 then
    match Y with
    | [::] => true
    | [:: y] => zeros y
    | _ => sum_is_zero f (two_by_two Y)
    end
  else false.
Fixpoint conserved (L : seq (nat * nat * nat)) (W : seq flow) : bool :=
  if W is w :: W' then if sum_is_zero 64 (lines L w) then conserved L W' else false else true.

Fixpoint distinct (L : seq (nat * nat * nat)) : bool :=
  if L is (i, j, _) :: L' then if eqn (direction i j 1 2) 0 then false else distinct L' else true.

(* 4 rank N + rank Lambda - m *)
Definition flow_rank k (L : seq (nat * nat * nat)) (W : seq flow) : nat :=
  if distinct L then
    if conserved L W then
      4 * size (pivots_of p (3 * k) (N_rows L)) + size (pivots_of p (size (filter has_column L)) (lambda_rows L W)) - size L
    else 0
  else 0.

(* a core, with flows or without *)
Definition core_rank k (L : seq (nat * nat * nat)) (W : seq flow) : nat :=
  if L is [::] then 0 else if W is [::] then rows_rank p cs k L else flow_rank k L W.
End Program.

(* ------------------------------------------------------------------ one edge *)
Local Open Scope ring_scope.

(* Lemma 3.1, from (a) to (b), in coordinates: F (dP_i - dP_j) is a multiple of F P_j. *)
Section Edge.
Variables (K : fieldType) (ci cj : nat -> K) (v : nat -> nat -> K).
Hypothesis two0 : 2%:R != 0 :> K.
Notation f := (F_entry (0 : K) +%R -%R ci cj).
Notation g := (M_entry (0 : K) +%R *%R -%R ci cj).
(* F v, and M v; F P_j *)
Definition Fv h b := f h 0 * v 0%N b + f h 1 * v 1%N b + f h 2 * v 2%N b.
Definition Mv a b := g a 0%N * v 0%N b + g a 1%N * v 1%N b + g a 2%N * v 2%N b.
Definition FP h b := if (b < 3)%N then f h b else - (f h 0 * cj 0%N + f h 1 * cj 1%N + f h 2 * cj 2%N).

Lemma lemma_3_1 : (forall a b, (a < 4)%N -> (b < 4)%N -> Mv a b + Mv b a = 0) ->
  forall h b, (h < 3)%N -> (b < 4)%N -> f 1 2 * Fv h b = Fv 1 2 * FP h b.
Proof.
move=> skew.
have diag h : (h < 3)%N -> Fv h h = 0.
  move=> h3; have := skew h h (ltnW h3) (ltnW h3); rewrite /Mv /M_entry h3 -/(Fv h h) -mulr2n -mulr_natl.
  by move/eqP; rewrite mulf_eq0 (negbTE two0) => /eqP.
have off h b : (h < 3)%N -> (b < 3)%N -> Fv h b = - Fv b h.
  move=> h3 b3; have := skew h b (ltnW h3) (ltnW b3); rewrite /Mv /M_entry h3 b3 -/(Fv h b) -/(Fv b h).
  by move/eqP; rewrite addr_eq0 => /eqP.
have orth b : f 1 2 * Fv 0 b = f 0 2 * Fv 1 b - f 0 1 * Fv 2 b.
  by rewrite /Fv /F_entry /diff; ring.
have inner h b : (h < 3)%N -> (b < 3)%N -> f 1 2 * Fv h b = Fv 1 2 * f h b.
  have e01 : f 1 2 * Fv 0 1 = Fv 1 2 * f 0 1 by rewrite orth (off 2%N 1%N) // diag // /F_entry; ring.
  have e02 : f 1 2 * Fv 0 2 = Fv 1 2 * f 0 2 by rewrite orth (diag 2%N) // /F_entry; ring.
  have e00 i : (i < 3)%N -> f 1 2 * Fv i i = Fv 1 2 * f i i.
    by move=> i3; rewrite diag // /F_entry; move: i i3; case=> [|[|[|//]]] _; rewrite !mulr0.
  move: h b; case=> [|[|[|//]]]; case=> [|[|[|//]]] _ _; rewrite ?e00 ?e01 ?e02 //.
  - by rewrite off // mulrN e01 /F_entry; ring.
  - by rewrite mulrC.
  - by rewrite off // mulrN e02 /F_entry; ring.
  - by rewrite off // /F_entry; ring.
move=> h b h3; case: (ltnP b 3) => [b3 _|b3 b4]; first by rewrite /FP b3 inner.
have -> : b = 3%N by lia.
rewrite /FP ltnn.
have last : Fv h 3 = cj 0%N * Fv 0 h + cj 1%N * Fv 1 h + cj 2%N * Fv 2 h.
  have := skew h 3%N (ltnW h3) isT; rewrite /Mv /M_entry h3 /= -/(Fv h 3) => /eqP; rewrite addr_eq0 => /eqP ->.
  by rewrite /Fv /F_entry; ring.
rewrite last 2!mulrDr; set d := f 1 2.
have e c : (c < 3)%N -> d * (cj c * Fv c h) = cj c * (Fv 1 2 * f c h).
  by move=> c3; rewrite mulrCA inner.
rewrite !e //; move: (Fv 1 2) h3 {last e} => z; move: h; case=> [|[|[|//]]] _; rewrite /F_entry; ring.
Qed.
End Edge.

(* ------------------------------------------------------------------ Corollary 3.3 *)
Lemma combine (R : comRingType) (x y : R) (a b v : nat -> R) :
  (x * a 0%N + y * b 0%N) * v 0%N + ((x * a 1%N + y * b 1%N) * v 1%N + (x * a 2%N + y * b 2%N) * v 2%N)
  = x * (a 0%N * v 0%N + a 1%N * v 1%N + a 2%N * v 2%N) + y * (b 0%N * v 0%N + b 1%N * v 1%N + b 2%N * v 2%N).
Proof. by ring. Qed.
Lemma spread (R : comRingType) (g0 g1 g2 a0 a1 a2 b0 b1 b2 : R) :
  g0 * (a0 - b0) + g1 * (a1 - b1) + g2 * (a2 - b2)
  = g0 * a0 + (g1 * a1 + (g2 * a2 + (- g0 * b0 + (- g1 * b1 + (- g2 * b2 + 0))))).
Proof. by ring. Qed.
Lemma zip_first (S T : eqType) (s : seq S) (t : seq T) e x : (e, x) \in zip s t -> e \in s.
Proof.
elim: s t => [|a s ih] [|b t] //=; rewrite !inE => /predU1P [[-> _]|/ih ->]; rewrite ?eqxx ?orbT //.
Qed.
Lemma factor (R : comRingType) (x y a b m : R) : (x * a + y * b) * m = x * (m * a) + y * (m * b).
Proof. by ring. Qed.
Lemma two_sided (R : comRingType) (g : nat -> nat -> R) (a c : nat) (x y : nat -> nat -> R) :
  g a 0%N * x 0%N c + (g a 1%N * x 1%N c + (g a 2%N * x 2%N c + (g c 0%N * x 0%N a + (g c 1%N * x 1%N a + (g c 2%N * x 2%N a
  + (- g a 0%N * y 0%N c + (- g a 1%N * y 1%N c + (- g a 2%N * y 2%N c
  + (- g c 0%N * y 0%N a + (- g c 1%N * y 1%N a + (- g c 2%N * y 2%N a + 0)))))))))))
  = g a 0%N * (x 0%N c - y 0%N c) + g a 1%N * (x 1%N c - y 1%N c) + g a 2%N * (x 2%N c - y 2%N c)
    + (g c 0%N * (x 0%N a - y 0%N a) + g c 1%N * (x 1%N a - y 1%N a) + g c 2%N * (x 2%N a - y 2%N a)).
Proof. by ring. Qed.

Section Sound.
Variable p : nat.
Hypotheses (p_prime : prime p) (p_odd : (2 < p)%N).
Notation Fp := 'F_p.
Variables (n : nat) (cs : nat -> nat -> nat).
Notation motion := (cameras [comRingType of Fp] n).
Implicit Types (w : motion) (L : seq (nat * nat * nat)).

Lemma two_not_zero : 2%:R != 0 :> Fp.
Proof. by rewrite -(dvdn_charf (char_Fp p_prime)) gtnNdvd. Qed.

Notation f i j := (F_entry (0 : Fp) +%R -%R (csF p cs i) (csF p cs j)).
(* column k of a motion as unknowns of N; the difference of two nodes *)
Definition column k w (c : nat) : Fp := coord w (key (c %/ 3) (c %% 3) k).
Definition across w i j h b : Fp := coord w (key i h b) - coord w (key j h b).

Lemma directionE i j h c : (direction p cs i j h c)%:R = f i j h c.
Proof. exact: F_entryE. Qed.

Definition omegaF i j (x : nat * nat) c : Fp := x.1%:R * f i j 1 c + x.2%:R * f i j 2 c.
Lemma omegaE i j x c : (omega p cs i j x c)%:R = omegaF i j x c.
Proof. by rewrite /omega addpE // !mulpE // !directionE. Qed.

Lemma planeE i j x k : (k < 4)%N ->
  (plane p cs i j x k)%:R = x.1%:R * FP (csF p cs i) (csF p cs j) 1 k + x.2%:R * FP (csF p cs i) (csF p cs j) 2 k.
Proof.
move=> k4; rewrite /plane /FP; case: ifP => _; first exact: omegaE.
rewrite opppE // addpE // mulpE // addpE // !mulpE // !omegaE /omegaF /csF.
move: (f i j 1) (f i j 2) (x.1%:R) (x.2%:R) ((cs j 0)%:R) ((cs j 1)%:R) ((cs j 2)%:R) => g1 g2 a b c0 c1 c2.
by ring.
Qed.

Lemma lineE i j a k w : eval (line p i j a) (column k w) = \sum_(c < 3) (a c)%:R * across w i j c k.
Proof.
rewrite !big_ord_recl big_ord0 /eval /line !big_cons big_nil /= /across /column !opppE // !addr0.
have e v c : (c < 3)%N -> ((3 * v + c) %/ 3 = v)%N /\ ((3 * v + c) %% 3 = c)%N.
  by move=> c3; rewrite mulnC divnMDl // modnMDl divn_small ?modn_small ?addn0.
have e0 v : ((3 * v) %/ 3 = v)%N /\ ((3 * v) %% 3 = 0)%N by have := e v 0%N isT; rewrite addn0.
have [-> ->] := e0 i; have [-> ->] := e0 j; have [-> ->] := e i 1%N isT; have [-> ->] := e j 1%N isT.
have [-> ->] := e i 2%N isT; have [-> ->] := e j 2%N isT.
rewrite /bump /= ?addn0 ?add1n.
by ring.
Qed.

Notation Fd w e := (Fv (csF p cs e.1.1) (csF p cs e.1.2) (across w e.1.1 e.1.2)).
Notation FPd e := (FP (csF p cs e.1.1) (csF p cs e.1.2)).

Lemma lineF i j h k w : eval (line p i j (direction p cs i j h)) (column k w)
  = Fv (csF p cs i) (csF p cs j) (across w i j) h k.
Proof. by rewrite lineE !big_ord_recl big_ord0 !directionE /Fv /= addr0 !addrA. Qed.
Lemma line_omega i j x k w : eval (line p i j (omega p cs i j x)) (column k w)
  = x.1%:R * Fv (csF p cs i) (csF p cs j) (across w i j) 1 k + x.2%:R * Fv (csF p cs i) (csF p cs j) (across w i j) 2 k.
Proof.
rewrite lineE !big_ord_recl big_ord0 !omegaE /omegaF.
rewrite [nat_of_ord _]/= -[nat_of_ord (lift ord0 ord0)]/1%N -[nat_of_ord (lift _ (lift _ _))]/2%N.
by have := combine x.1%:R x.2%:R (f i j 1) (f i j 2) (fun c => across w i j c k); rewrite /Fv addr0 => <-.
Qed.

(* sums of rows *)
Lemma two_by_twoP u (Y : seq sparse) : \sum_(y <- two_by_two p Y) eval y u = \sum_(y <- Y) eval y u :> Fp.
Proof.
have [m le] := ubnP (size Y); elim: m Y le => // m ih [|y1 [|y2 Y]] // le.
rewrite [two_by_two p _]/=; rewrite !big_cons eval_axpy // mul1r addrA ih //.
by move: le => /=; lia.
Qed.
Lemma zerosP u y : zeros y -> eval y u = 0 :> Fp.
Proof.
elim: y => [|[k x] y ih] /=; first by rewrite eval_nil.
by case: eqnP => // -> /ih e; rewrite eval_cons e mul0r addr0.
Qed.
Lemma sum_is_zeroP u fuel Y : sum_is_zero p fuel Y -> \sum_(y <- Y) eval y u = 0 :> Fp.
Proof.
elim: fuel Y => // m ih [|y1 [|y2 Y]]; first by rewrite big_nil.
  by rewrite /= big_seq1; apply: zerosP.
by move/ih => /=; rewrite -(two_by_twoP u (y1 :: _)).
Qed.

Arguments sum_is_zero : simpl never.
Arguments sorted_row : simpl never.
Arguments line : simpl never.

(* w^T N y = 0 in column k of a motion *)
Lemma conservedP L W x k w : conserved p cs L W -> x \in W ->
  \sum_(ex <- zip L x) (ex.2.1%:R * Fd w ex.1 1%N k + ex.2.2%:R * Fd w ex.1 2%N k) = 0.
Proof.
elim: W => [|x' W ih] //; rewrite [conserved _ _ _ _]/=; case: ifP => [z|//] /ih {}ih; rewrite inE => /predU1P [->|/ih //].
rewrite -[RHS](sum_is_zeroP (column k w) z); elim: L x' {z ih} => [|[[i j] mask] L ih] [|x' X] //; rewrite ?big_nil //.
by rewrite [lines _ _ _ _]/= [zip _ _]/= !big_cons eval_sorted // line_omega ih.
Qed.

(* the scale of an edge, less its sign: F (dP_i - dP_j) = mu F P_j *)
Definition mu w (e : nat * nat) : Fp := Fv (csF p cs e.1) (csF p cs e.2) (across w e.1 e.2) 1 2 / f e.1 e.2 1 2.
Definition mu_form (e : nat * nat) : seq (nat * Fp) :=
  let g := f e.1 e.2 1 in
  [:: (key e.1 0 2, g 0%N); (key e.1 1 2, g 1%N); (key e.1 2 2, g 2%N);
      (key e.2 0 2, - g 0%N); (key e.2 1 2, - g 1%N); (key e.2 2 2, - g 2%N)].
Lemma mu_formE w e : value (mu_form e) w = 0 -> mu w e = 0.
Proof.
rewrite /mu => e0; suff -> : Fv (csF p cs e.1) (csF p cs e.2) (across w e.1 e.2) 1 2 = 0 by rewrite mul0r.
move: e0; rewrite /value /mu_form /Fv; move: (f e.1 e.2 1%N) => g.
by rewrite !big_cons big_nil /= => <-; rewrite /across spread.
Qed.

Lemma lambda_rowE k e0 L x w u : (k < 4)%N ->
  (forall e, e \in L -> ~~ has_column e -> mu w e.1 = 0) ->
  (forall t, nth 0 [seq mu w e.1 | e <- L & has_column e] t = u (e0 + t)%N) ->
  eval (lambda_row p cs k e0 L x) u
  = \sum_(ex <- zip L x) (ex.2.1%:R * FPd ex.1 1%N k + ex.2.2%:R * FPd ex.1 2%N k) * mu w ex.1.1.
Proof.
move=> k4; elim: L e0 x => [|[[i j] mask] L ih] e0 [|x X] col u0; rewrite /= ?/eval ?big_nil // big_cons.
set m := mu w (i, j).
have rest e : e \in L -> ~~ has_column e -> mu w e.1 = 0 by move=> eL; apply: col; rewrite inE eL orbT.
have := col (i, j, mask); move: u0; rewrite [filter _ _]/= mem_head; case: ifP => /= bit u0 m0.
  have -> : m = u e0 by have := u0 0%N; rewrite /= addn0.
  by rewrite big_cons /= planeE //; congr (_ + _); apply: ih => // t; rewrite addSnnS -u0.
by rewrite /m m0 // mulr0 add0r; apply: ih.
Qed.

(* a motion that the equation of an edge allows *)
Lemma allowed_skew (i j : 'I_n) w : equation (normal n (csF p cs)) (i, j) w = 0 ->
  f i j 1 2 != 0 -> forall h b, (h < 3)%N -> (b < 4)%N ->
  Fv (csF p cs i) (csF p cs j) (across w i j) h b = mu w (val i, val j) * FP (csF p cs i) (csF p cs j) h b.
Proof.
move=> eq0 d0 h b h3 b4; apply: (mulfI d0); rewrite /mu /= mulrA [_ * (_ / _)]mulrC divfK //.
apply: (lemma_3_1 two_not_zero) => // a c a4 c4.
have := equation_normal (csF p cs) i j (Ordinal a4) (Ordinal c4) w; rewrite eq0 mxE => ->.
rewrite /value /Mv /combination; move: (M_entry _ _ _ _ _ _) => g.
rewrite !big_cons big_nil /=.
exact/esym/(two_sided g a c (fun h b => coord w (key i h b)) (fun h b => coord w (key j h b))).
Qed.

Lemma distinctP L : distinct p cs L -> forall e, e \in L -> f e.1.1 e.1.2 1 2 != 0.
Proof.
elim: L => //= -[[i j] mask] L ih; case: eqnP => // ne /ih {}ih e; rewrite inE => /predU1P [->|/ih //].
have : (direction p cs i j 1 2)%:R != 0 :> Fp; last by rewrite directionE.
rewrite -(dvdn_charf (char_Fp p_prime)) gtnNdvd ?lt0n; first by [].
  exact/eqP.
by rewrite /direction /F_entry /diff /addp ltn_mod prime_gt0.
Qed.

Lemma N_rowsP L y : y \in N_rows p cs L -> exists2 e, e \in L & exists2 h, (h < 3)%N & y = line p e.1.1 e.1.2 (direction p cs e.1.1 e.1.2 h).
Proof.
elim: L => [|[[i j] mask] L ih] //; rewrite [N_rows _ _ _]/= => yL.
have : [|| y == line p i j (direction p cs i j 1), y == line p i j (direction p cs i j 2) | y \in N_rows p cs L].
  by move: yL; do 2!case: ifP => _; rewrite ?inE => h; do ?[case/orP: h => h]; rewrite ?h ?orbT.
case/or3P=> [/eqP -> | /eqP -> | /ih [e eL h]]; last by exists e; rewrite // inE eL orbT.
  by exists (i, j, mask); [exact: mem_head | exists 1%N].
by exists (i, j, mask); [exact: mem_head | exists 2%N].
Qed.

Lemma lambda_rowsP L W y : y \in lambda_rows p cs L W -> exists2 x, x \in W & exists2 k, (k < 4)%N & y = lambda_row p cs k 0 L x.
Proof.
elim: W => //= x W ih; rewrite !inE.
case/or4P=> [/eqP -> | /eqP -> | /eqP -> | /predU1P [-> | /ih [x' xW h]]]; last by exists x'; rewrite // inE xW orbT.
- by exists x; [exact: mem_head | exists 0%N].
- by exists x; [exact: mem_head | exists 1%N].
- by exists x; [exact: mem_head | exists 2%N].
- by exists x; [exact: mem_head | exists 3%N].
Qed.

Lemma column_big k w c : (3 * n <= c)%N -> column k w c = 0.
Proof. by move=> nc; apply: coord_big; rewrite /key; have := leq_div2r 3 nc; rewrite mulKn //; lia. Qed.

Lemma coord_column w k : coord w k = column (k %% 4) w (3 * (k %/ 12) + k %% 12 %/ 4).
Proof.
rewrite /column; congr (coord w _); have r3 : (k %% 12 %/ 4 < 3)%N by rewrite ltn_divLR // ltn_mod.
rewrite [(3 * _)%N]mulnC divnMDl // (divn_small r3) addn0 modnMDl (modn_small r3) /key.
have m : (k %% 12 %% 4 = k %% 4)%N by apply: modn_dvdm.
by have := divn_eq k 12; have := divn_eq (k %% 12) 4; rewrite m; lia.
Qed.

(* rank J_P >= 4 a + b - m for rows of N and Lambda with a and b pivots *)
Theorem corollary_3_3 L W : all (fun e => (e.1.1 < n) && (e.1.2 < n))%N L ->
  (flow_rank p cs n L W <= \rank (J (edges n (pairs_of L)) (normal n (csF p cs))))%N.
Proof.
move=> /allP lt; rewrite /flow_rank; case: ifP => // /distinctP d0; case: ifP => // cons.
set YN := N_rows p cs L; set YL := lambda_rows p cs L W; set L1 := filter _ L; set A := J _ _.
set N1 := (3 * n)%N; set m1 := size L1.
have := size_free p N1 YN; have := size_free p m1 YL.
set ZN := pivots_of p N1 YN; set ZL := pivots_of p m1 YL => sL sN.
pose e0 : nat * nat * nat := ((0, 0), 0)%N.
pose forms_y := [seq [:: (key (c %/ 3) (c %% 3) k, 1 : Fp)] | c <- free N1 ZN, k <- iota 0 4].
pose forms_l := [seq mu_form (nth e0 L1 c).1 | c <- free m1 ZL].
pose forms_o := [seq mu_form e.1 | e <- L & ~~ has_column e].
have sizes : size (forms_y ++ forms_l ++ forms_o) = (4 * size (free N1 ZN) + size (free m1 ZL) + (size L - m1))%N.
  rewrite !size_cat size_allpairs !size_map size_iota mulnC addnA; congr (_ + _)%N.
  by rewrite /m1 /L1 !size_filter -(count_predC has_column L) addKn.
have m1L : (m1 <= size L)%N by rewrite /m1 size_filter count_size.
suff : (12 * n <= \rank A + size (forms_y ++ forms_l ++ forms_o))%N by rewrite sizes /N1 in sN *; lia.
apply: (rank_by_forms p_prime) => w wE w0.
have w0y c k : c \in free N1 ZN -> (k < 4)%N -> column k w c = 0.
  move=> cf k4; have := w0 [:: (key (c %/ 3) (c %% 3) k, 1 : Fp)]; rewrite /value big_seq1 /= mul1r; apply.
  by rewrite mem_cat; apply/orP; left; apply/allpairsP; exists (c, k); rewrite mem_iota.
have skew e : e \in L -> forall h b, (h < 3)%N -> (b < 4)%N -> Fd w e h b = mu w e.1 * FPd e h b.
  move=> eL; have /andP [iN jN] := lt _ eL; move: (d0 _ eL) iN jN => de iN jN h b.
  have := @allowed_skew (Ordinal iN) (Ordinal jN) w; rewrite /= -surjective_pairing; apply=> //.
  by apply: wE; apply/edges_mem; rewrite /= -surjective_pairing; apply: (map_f fst eL).
have mu_o e : e \in L -> ~~ has_column e -> mu w e.1 = 0.
  move=> eL ne; apply/mu_formE/w0; rewrite !mem_cat; apply/orP; right; apply/orP; right.
  by apply: (map_f (fun e : nat * nat * nat => mu_form e.1)); rewrite mem_filter ne.
pose u t := nth 0 [seq mu w e.1 | e <- L1] t.
have u0 : forall t, u t = 0.
  apply: (pivots_sound p_prime (N := m1) (Y := YL)) => [y|t mt|t tf].
  - case/lambda_rowsP=> x xW [k k4 ->]; rewrite (@lambda_rowE k 0 L x w u k4 mu_o) //.
    rewrite -[RHS](conservedP k w cons xW); apply: eq_big_seq => -[e x'] ex /=.
    have eL := zip_first ex.
    by rewrite !skew //; exact: factor.
  - by rewrite /u nth_default // size_map.
  - have tm : (t < m1)%N by move: tf; rewrite mem_filter mem_iota => /andP [].
    rewrite /u (nth_map e0) //; apply/mu_formE/w0; rewrite !mem_cat; apply/orP; right; apply/orP; left.
    exact: (map_f (fun c => mu_form (nth e0 L1 c).1) tf).
have mu0 e : e \in L -> mu w e.1 = 0.
  move=> eL; case: (boolP (has_column e)) => [he|]; last exact: mu_o.
  have eL1 : e \in L1 by rewrite mem_filter he.
  by have := u0 (index e L1); rewrite /u (nth_map e0) ?index_mem // nth_index.
have y0 k : (k < 4)%N -> forall c, column k w c = 0.
  move=> k4; apply: (pivots_sound p_prime (N := N1) (Y := YN)) => [y|c|c cf].
  - by case/N_rowsP=> e eL [h h3 ->]; rewrite lineF skew // mu0 // mul0r.
  - exact: column_big.
  - exact: w0y.
by move=> k; rewrite coord_column y0 // ltn_mod.
Qed.

Theorem core_rank_modp L W : all (fun e => (e.1.1 < n) && (e.1.2 < n))%N L ->
  (core_rank p cs n L W <= \rank (J (edges n (pairs_of L)) (normal n (csF p cs))))%N.
Proof.
move=> lt; rewrite /core_rank; case e: L => [//|x L']; rewrite -e.
by case: W => [|y W]; [exact: rows_rank_modp | exact: corollary_3_3].
Qed.

Theorem core_rank_sound L W : all (fun e => (e.1.1 < n) && (e.1.2 < n))%N L ->
  attained (edges n (pairs_of L)) (core_rank p cs n L W).
Proof. by move/(core_rank_modp W)/lifted. Qed.
End Sound.
