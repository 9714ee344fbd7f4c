(* Proposition 1.4 as a program: elimination modulo p at given centres, and what its result means.

   Columns are eliminated in increasing order. Rows wait in a heap, the one that begins first on top. Nothing has to be
   complete: what is left when the program stops are rows that vanish on every solution of those it began with, and
   [staircase] looks whether they are in echelon form. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Generic NormalForm Rigid.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.

Section Program.
Variable p : nat.
Definition addp a b := (a + b) %% p.
Definition mulp a b := (a * b) %% p.
Definition oppp a := (p - a %% p) %% p.

(* a row: columns and entries, by increasing columns *)
Definition sparse := seq (nat * nat).

(* s y1 + y2 *)
Fixpoint axpy s (y1 : sparse) : sparse -> sparse :=
  match y1 with
  | [::] => fun y2 => y2
  | (k1, x1) :: t1 => fix with_ (y2 : sparse) : sparse :=
    match y2 with
    | [::] => (k1, mulp s x1) :: axpy s t1 [::]
    | (k2, x2) :: t2 =>
      if k1 < k2 then (k1, mulp s x1) :: axpy s t1 y2
      else if k2 < k1 then (k2, x2) :: with_ t2
      else let x := addp (mulp s x1) x2 in
           if eqn x 0 then axpy s t1 t2 else (k1, x) :: axpy s t1 t2
    end
  end.

Fixpoint sorted_row (y : sparse) : sparse :=
  if y is (k, x) :: t then
    let z := sorted_row t in if eqn x 0 then z else axpy 1 [:: (k, x)] z
  else [::].

Fixpoint power fuel x k : nat :=
  if fuel is f.+1 then
    if eqn k 0 then 1 else
    let h := power f (mulp x x) (k %/ 2) in if eqn (k %% 2) 0 then h else mulp x h
  else 1.

(* a heap of rows that are not empty: first column, its entry, the rest of the row *)
Inductive heap := Leaf | Node of nat & nat & sparse & heap & heap.
Fixpoint meld (h1 : heap) : heap -> heap :=
  match h1 with
  | Leaf => fun h2 => h2
  | Node c1 x1 t1 l1 r1 => fix with_ (h2 : heap) : heap :=
    match h2 with
    | Leaf => h1
    | Node c2 x2 t2 l2 r2 =>
      if c1 <= c2 then Node c1 x1 t1 (meld r1 h2) l1 else Node c2 x2 t2 (with_ r2) l2
    end
  end.
Definition push (y : sparse) h := if y is (c, x) :: t then meld (Node c x t Leaf Leaf) h else h.
Fixpoint push_all (Y : seq sparse) h := if Y is y :: Z then push_all Z (push (sorted_row y) h) else h.

(* a pivot row has the entry 1 in its first column; given are this column and the rest *)
Definition pivot := (nat * sparse)%type.
Fixpoint eliminate fuel (now : pivot) (h : heap) (done : seq pivot) : seq pivot :=
  if fuel is f.+1 then
    match h with
    | Leaf => now :: done
    | Node c x t l r =>
      if eqn c now.1 then eliminate f now (push (axpy (oppp x) now.2 t) (meld l r)) done
      else let s := power 64 x (p - 2) in
           if eqn (mulp s x) 1 then eliminate f (c, axpy s t [::]) (meld l r) (now :: done) else now :: done
    end
  else done.

Fixpoint above c (t : sparse) := if t is (k, _) :: t' then if c < k then above c t' else false else true.
Fixpoint staircase bound (Z : seq pivot) :=
  if Z is (c, t) :: Z' then if c < bound then if above c t then staircase c Z' else false else false else true.

(* what is left of some rows with entries in columns below N; nothing if it is not in echelon form *)
Definition pivots_of N (Y : seq sparse) : seq pivot :=
  match push_all Y Leaf with
  | Leaf => [::]
  | Node c x t l r =>
    let s := power 64 x (p - 2) in
    if eqn (mulp s x) 1 then
      let Z := eliminate (size Y * N).+1 (c, axpy s t [::]) (meld l r) [::] in
      if staircase N Z then Z else [::]
    else [::]
  end.

(* pairs of nodes 0 .. k-1 at centres cs; bit t of the number with a pair says whether its t-th row is used *)
Definition entries10 : seq (nat * nat) :=
  [:: (0, 0); (0, 1); (0, 2); (0, 3); (1, 1); (1, 2); (1, 3); (2, 2); (2, 3); (3, 3)].
Section Rows.
Variable cs : nat -> nat -> nat.
Fixpoint rows_of i j mask (ab : seq (nat * nat)) (tail : seq sparse) : seq sparse :=
  if ab is (a, b) :: ab' then
    let more := rows_of i j (mask %/ 2) ab' tail in
    if eqn (mask %% 2) 0 then more
    else combination 0 addp mulp oppp (cs i) (cs j) i j a b :: more
  else tail.
Fixpoint all_rows (L : seq (nat * nat * nat)) : seq sparse :=
  if L is (i, j, mask) :: L' then rows_of i j mask entries10 (all_rows L') else [::].
Definition rows_rank k (L : seq (nat * nat * nat)) : nat := size (pivots_of (12 * k) (all_rows L)).

(* what the equation of nodes i and j says of a motion, by its entries *)
Section Motion.
Variable motion : nat -> nat.
Fixpoint dot (y : sparse) : nat := if y is (k, x) :: t then addp (mulp x (motion k)) (dot t) else 0.
Fixpoint solved i j (ab : seq (nat * nat)) : bool :=
  if ab is (a, b) :: ab' then
    if eqn (dot (combination 0 addp mulp oppp (cs i) (cs j) i j a b)) 0 then solved i j ab' else false
  else true.
Fixpoint all_solved (L : seq (nat * nat * nat)) : bool :=
  if L is (i, j, _) :: L' then if solved i j entries10 then all_solved L' else false else true.
End Motion.
End Rows.
End Program.
Arguments power : simpl never.

Local Open Scope ring_scope.
Section Sound.
Variable p : nat.
Hypothesis p_prime : prime p.
Notation Fp := 'F_p.

Lemma addpE a b : (addp p a b)%:R = a%:R + b%:R :> Fp.
Proof. by rewrite /addp Fp_nat_mod // natrD. Qed.
Lemma mulpE a b : (mulp p a b)%:R = a%:R * b%:R :> Fp.
Proof. by rewrite /mulp Fp_nat_mod // natrM. Qed.
Lemma opppE a : (oppp p a)%:R = - a%:R :> Fp.
Proof.
rewrite /oppp Fp_nat_mod // -[in RHS](Fp_nat_mod p_prime a) natrB; last by rewrite ltnW // ltn_mod prime_gt0.
by rewrite -[X in X - _](Fp_nat_mod p_prime p) modnn sub0r.
Qed.

(* a row at unknowns u *)
Implicit Types (u : nat -> Fp) (y : sparse) (z : pivot) (h : heap).
Definition eval y u : Fp := \sum_(kx <- y) kx.2%:R * u kx.1.
Lemma eval_cons k x y u : eval ((k, x) :: y) u = x%:R * u k + eval y u.
Proof. by rewrite /eval big_cons. Qed.
Lemma eval_nil u : eval [::] u = 0. Proof. by rewrite /eval big_nil. Qed.

Lemma eval_axpy s y (z : sparse) u : eval (axpy p s y z) u = s%:R * eval y u + eval z u.
Proof.
elim: y z => [|[k x] y ihy] z; first by rewrite eval_nil mulr0 add0r.
elim: z => [|[l w] z ihz] /=; first by rewrite !eval_cons ihy mulpE mulrDr mulrA eval_nil !addr0.
rewrite -/(axpy p s ((k, x) :: y)); case: ltngtP => /= kl.
- by rewrite eval_cons ihy !eval_cons mulpE mulrDr mulrA addrA.
- by rewrite eval_cons ihz !eval_cons addrCA.
rewrite kl; set w' := addp _ _ _.
have -> : eval (if eqn w' 0 then axpy p s y z else (l, w') :: axpy p s y z) u
  = w'%:R * u l + eval (axpy p s y z) u.
  by case: eqnP => [->|_]; rewrite ?eval_cons // mul0r add0r.
by rewrite ihy !eval_cons addpE mulpE mulrDl mulrDr mulrA addrACA.
Qed.

Lemma eval_sorted y u : eval (sorted_row p y) u = eval y u.
Proof.
elim: y => [|[k x] y ih] //; rewrite eval_cons.
rewrite -[sorted_row p _]/(if eqn x 0 then sorted_row p y else axpy p 1 [:: (k, x)] (sorted_row p y)).
case: eqnP => [->|_].
  by rewrite mul0r add0r ih.
by rewrite eval_axpy mul1r !eval_cons eval_nil addr0 ih.
Qed.

(* u vanishes on all rows of a heap; on pivot rows *)
Fixpoint vanishes u h : Prop :=
  if h is Node c x t l r then [/\ eval ((c, x) :: t) u = 0, vanishes u l & vanishes u r] else True.
Definition solves u (z : pivot) := u z.1 + eval z.2 u = 0.

Lemma vanishes_meld u h1 h2 : vanishes u h1 -> vanishes u h2 -> vanishes u (meld h1 h2).
Proof.
elim: h1 h2 => [|c1 x1 t1 l1 _ r1 ih1] h2 //= v1.
elim: h2 => [|c2 x2 t2 l2 _ r2 ih2] //= v2; case: v1 v2 => e1 vl1 vr1 [e2 vl2 vr2].
by case: ifP => _; split=> //; [apply: ih1 | apply: ih2].
Qed.
Lemma vanishes_push u y h : eval y u = 0 -> vanishes u h -> vanishes u (push y h).
Proof. by case: y => [|[c x] t] // e v; apply: vanishes_meld. Qed.
Lemma vanishes_all u (Y : seq sparse) h : (forall y, y \in Y -> eval y u = 0) -> vanishes u h -> vanishes u (push_all p Y h).
Proof.
elim: Y h => //= y Y ih h all v; apply: ih => [z zY|]; first by apply: all; rewrite inE zY orbT.
by apply: vanishes_push; rewrite ?eval_sorted ?all ?mem_head.
Qed.

Lemma solves_scaled u s c x t : eqn (mulp p s x) 1 -> eval ((c, x) :: t) u = 0 -> solves u (c, axpy p s t [::]).
Proof.
move=> /eqnP sx e; rewrite /solves /= eval_axpy eval_nil addr0.
have sx1 : s%:R * x%:R = 1 :> Fp by rewrite -mulpE sx.
have -> : u c + s%:R * eval t u = s%:R * eval ((c, x) :: t) u by rewrite eval_cons mulrDr mulrA sx1 mul1r.
by rewrite e mulr0.
Qed.

Lemma eliminate_sound u fuel now h (done : seq pivot) : solves u now -> vanishes u h -> (forall z, z \in done -> solves u z) ->
  forall z, z \in eliminate p fuel now h done -> solves u z.
Proof.
have cons now' D : solves u now' -> (forall z, z \in D -> solves u z) -> forall z, z \in now' :: D -> solves u z.
  by move=> s d z; rewrite inE => /predU1P [-> | /d].
elim: fuel now h done => //= f ih now [|c x t l r] done s; first by move=> _; apply: cons.
move=> [e vl vr] d; case: eqnP => [cn|_].
  apply: ih => //; apply: vanishes_push; last exact: vanishes_meld.
  have -> : eval (axpy p (oppp p x) now.2 t) u = eval ((c, x) :: t) u - x%:R * (u now.1 + eval now.2 u).
    by rewrite eval_axpy eval_cons opppE cn; ring.
  by rewrite e s mulr0 subr0.
case: ifP => sx; last exact: cons.
apply: ih (solves_scaled sx e) (vanishes_meld vl vr) (cons _ _ s d).
Qed.

Definition heads (Z : seq pivot) := [seq z.1 | z <- Z].
Lemma aboveP c t : above c t -> all (fun kx => c < kx.1)%N t.
Proof. by elim: t => //= [[k x] t ih]; case: ifP => //= _ /ih. Qed.

Lemma staircaseP bound Z : staircase bound Z ->
  [/\ all (fun c => c < bound)%N (heads Z), uniq (heads Z) & forall z, z \in Z -> above z.1 z.2].
Proof.
elim: Z bound => //= [[c t] Z ih] bound; case: ifP => //= cb; case: ifP => // at_ /ih [lt u ab].
split=> [||z]; last by rewrite inE => /predU1P [->|/ab].
  by apply/allP=> k kZ; apply: ltn_trans (allP lt _ kZ) cb.
by rewrite u andbT; apply/negP=> /(allP lt); rewrite ltnn.
Qed.

Lemma echelon u N Z : staircase N Z -> (forall z, z \in Z -> solves u z) ->
  (forall k, k \notin heads Z -> u k = 0) -> forall k, u k = 0.
Proof.
move=> /staircaseP [lt _ ab] sol free k.
have [d le] := ubnP (N - k); elim: d k le => // d ih k le.
case: (boolP (k \in heads Z)) => [/mapP [[c t] zZ /= kc]|]; last exact: free.
have := sol _ zZ; rewrite /solves /= -kc /eval big_seq big1 ?addr0 // => kx kxt.
have ck : (k < kx.1)%N by rewrite kc; apply: allP (aboveP (ab _ zZ)) _ kxt.
have kN : (k < N)%N by apply: allP lt _ _; rewrite kc (map_f fst zZ).
by rewrite ih ?mulr0 //; apply: leq_trans (ltn_sub2l kN ck) _.
Qed.

(* the columns without a pivot *)
Definition free N (Z : seq pivot) := [seq k <- iota 0 N | k \notin heads Z].

Lemma pivots_staircase N Y : staircase N (pivots_of p N Y).
Proof. by rewrite /pivots_of; case: push_all => // c x t l r; case: ifP => // _; case: ifP. Qed.

Lemma size_free N Y : (size (pivots_of p N Y) + size (free N (pivots_of p N Y)) = N)%N.
Proof.
have /staircaseP [ltZ uZ _] := pivots_staircase N Y; set Z := pivots_of p N Y in ltZ uZ *.
have -> : size Z = count (mem (heads Z)) (iota 0 N).
  rewrite -(size_map fst Z) -size_filter; apply/eqP; rewrite -uniq_size_uniq ?filter_uniq ?iota_uniq // => k.
  by rewrite mem_filter mem_iota /= add0n; case: (boolP (k \in heads Z)) => // /(allP ltZ) ->.
by rewrite /free size_filter (count_predC (mem (heads Z))) size_iota.
Qed.

(* Unknowns that satisfy all rows are zero if those without a pivot are. *)
Theorem pivots_sound N Y u : (forall y, y \in Y -> eval y u = 0) -> (forall k, (N <= k)%N -> u k = 0) ->
  (forall k, k \in free N (pivots_of p N Y) -> u k = 0) -> forall k, u k = 0.
Proof.
move=> uY big u0; apply: (echelon (pivots_staircase N Y)) => [z|k kZ]; last first.
  by case: (ltnP k N) => [kN|/big //]; apply: u0; rewrite mem_filter kZ mem_iota.
rewrite /pivots_of; have := vanishes_all (h := Leaf) uY I; case: push_all => [//|c x t l r] [e0 vl vr].
case: ifP => // sx; case: ifP => // _; apply: eliminate_sound => //.
  exact: solves_scaled sx e0.
exact: vanishes_meld.
Qed.

(* rows of J_P at centres cs *)
Variable n : nat.
Notation motion := (cameras [comRingType of Fp] n).
Implicit Types (w : motion).
Variable cs : nat -> nat -> nat.
Definition csF (v k : nat) : Fp := (cs v k)%:R.
Lemma F_entryE ci cj (h k : nat) : (F_entry 0%N (addp p) (oppp p) ci cj h k)%:R =
  F_entry (0 : Fp) +%R -%R (fun k => (ci k)%:R) (fun k => (cj k)%:R) h k.
Proof.
by move: h k; case=> [|[|[|h]]]; case=> [|[|[|k]]]; rewrite /F_entry /diff ?opppE ?addpE ?opppE ?mulr0n.
Qed.
Lemma M_entryE ci cj (h k : nat) : (M_entry 0%N (addp p) (mulp p) (oppp p) ci cj h k)%:R =
  M_entry (0 : Fp) +%R *%R -%R (fun k => (ci k)%:R) (fun k => (cj k)%:R) h k.
Proof. by rewrite /M_entry; case: ifP => _; rewrite ?opppE ?addpE ?mulpE ?addpE ?mulpE ?F_entryE. Qed.

Lemma row_sound (i j : 'I_n) (a b : 'I_4) w :
  eval (combination 0%N (addp p) (mulp p) (oppp p) (cs i) (cs j) i j a b) (coord w) = equation (normal n csF) (i, j) w a b.
Proof. by rewrite equation_normal /eval /value /combination !big_cons !big_nil /= !opppE !M_entryE. Qed.

Lemma rows_ofP i j mask ab tail y : y \in rows_of p cs i j mask ab tail -> y \in tail \/
  exists2 e, e \in ab & y = combination 0%N (addp p) (mulp p) (oppp p) (cs i) (cs j) i j e.1 e.2.
Proof.
elim: ab mask => [|[a b] ab ih] mask /=; first by left.
have more : y \in rows_of p cs i j (mask %/ 2) ab tail -> y \in tail \/ exists2 e, e \in (a, b) :: ab
  & y = combination 0%N (addp p) (mulp p) (oppp p) (cs i) (cs j) i j e.1 e.2.
  by case/ih=> [|[e eab ->]]; [left | right; exists e; rewrite // inE eab orbT].
case: ifP => // _; rewrite inE => /predU1P [->|//]; right; exists (a, b) => //; exact: mem_head.
Qed.

Arguments rows_of : simpl never.
Lemma all_rowsP L y : y \in all_rows p cs L -> exists2 e, e \in L & exists2 ab, ab \in entries10 &
  y = combination 0%N (addp p) (mulp p) (oppp p) (cs e.1.1) (cs e.1.2) e.1.1 e.1.2 ab.1 ab.2.
Proof.
elim: L => [|[[i j] mask] L ih] //; rewrite [all_rows _ _ _]/=; move=> /rows_ofP [/ih [e eL h] | [ab abL ->]].
  by exists e; rewrite // inE eL orbT.
by exists (i, j, mask); [exact: mem_head | exists ab].
Qed.

Definition pairs_of (L : seq (nat * nat * nat)) : seq (nat * nat) := [seq e.1 | e <- L].

Lemma edges_mem (G : seq (nat * nat)) (i j : 'I_n) : (val i, val j) \in G -> (i, j) \in edges n G.
Proof. by move=> ijG; rewrite mem_pmap; apply/mapP; exists (val i, val j); rewrite //= !valK. Qed.

Lemma coord_big w k : (12 * n <= k)%N -> coord w k = 0.
Proof. by move=> nk; rewrite /coord insubF // ltnNge leq_divRL // mulnC nk. Qed.

(* coordinates, as linear forms *)
Definition forms (Y : seq (seq (nat * Fp))) (u : 'rV[Fp]_(n * (3 * 4))) : 'rV[Fp]_(size Y) :=
  \row_k value (nth [::] Y k) (vec_mx u : motion).
Lemma value_linear (g : seq (nat * Fp)) : scalar (fun w : motion => value g w).
Proof.
move=> a v w; rewrite /value; elim: g => [|[k x] g ih]; first by rewrite !big_nil mulr0 addr0.
by rewrite !big_cons /= ih coord_linear !mulrDr !mulrA [a * x]mulrC addrACA.
Qed.
Lemma forms_is_linear Y : linear (forms Y).
Proof. by move=> a u v; apply/rowP=> k; rewrite !mxE linearP /= value_linear. Qed.

(* Only the zero motion solves the equations of E and makes some forms zero: then the rank is 12 n at least, less their
   number. *)
Lemma rank_by_forms E P Y : (forall w, (forall e, e \in E -> equation P e w = 0) ->
  (forall g, g \in Y -> value g w = 0) -> forall k, coord w k = 0) -> (12 * n <= \rank (J E P) + size Y)%N.
Proof.
move=> h; suff : (n * (3 * 4) <= \rank (J E P) + size Y)%N by lia.
apply: (rank_by_coordinates (C := lin1_mx (Linear (forms_is_linear Y)))) => u /eqP; rewrite J_ker => /allP uA.
rewrite mul_rV_lin1 /= => /rowP u0.
suff v0 : vec_mx u = 0 :> motion by rewrite -[u]vec_mxK v0 linear0.
apply: coord0 => k _; apply: h => [e /uA /eqP //|g gY].
have li : (index g Y < size Y)%N by rewrite index_mem.
by have := u0 (Ordinal li); rewrite !mxE /= nth_index.
Qed.

Lemma rows_rank_modp L : all (fun e => (e.1.1 < n) && (e.1.2 < n))%N L ->
  (rows_rank p cs n L <= \rank (J (edges n (pairs_of L)) (normal n csF)))%N.
Proof.
move=> /allP lt; rewrite /rows_rank; set Y := all_rows _ _ _; have := size_free (12 * n) Y; set A := J _ _.
suff : (12 * n <= \rank A + size (free (12 * n) (pivots_of p (12 * n) Y)))%N by lia.
have := @rank_by_forms (edges n (pairs_of L)) (normal n csF)
  [seq [:: (k, 1 : Fp)] | k <- free (12 * n) (pivots_of p (12 * n) Y)]; rewrite size_map; apply=> w wE w0.
apply: (pivots_sound (N := 12 * n) (Y := Y)) => [y|k|k kf].
- move=> /all_rowsP [[[i j] mask] eL [[a b] abL ->]].
  have /andP [/= iN jN] := lt _ eL.
  have /andP [/= a4 b4] : (a < 4)%N && (b < 4)%N.
    by apply: (allP (isT : all (fun ab => (ab.1 < 4)%N && (ab.2 < 4)%N) entries10) _ abL).
  rewrite (row_sound (Ordinal iN) (Ordinal jN) (Ordinal a4) (Ordinal b4)).
  by rewrite wE ?mxE //; apply/edges_mem/(map_f fst eL).
- exact: coord_big.
- by have := w0 _ (map_f _ kf); rewrite /value big_seq1 /= mul1r.
Qed.

(* Proposition 1.4. A rank at these centres modulo p is one of rational cameras. *)
Lemma lifted E r : (r <= \rank (J E (normal n csF)))%N -> attained E r.
Proof.
move=> h; pose cZ v k : int := (cs v k)%:Z.
exists (normal n (fun v k => (cZ v k)%:~R)); apply: leq_trans h _.
have e (R : comRingType) : normal n (fun v k => (cZ v k)%:~R : R) = map_mx intr (normal n cZ).
  apply/row_matrixP=> v; rewrite -map_row !rowK.
  rewrite (map_mxvec (intmul1_rmorphism R)); congr mxvec; apply/matrixP=> i k.
  by rewrite !mxE /normal_entry; case: ifP => _; [case: (_ == _) | exact/esym/(rmorphN (intmul1_rmorphism R))].
have -> : normal n csF = map_mx intr (normal n cZ).
  by rewrite -e; apply/row_matrixP=> v; rewrite !rowK.
rewrite e -(map_J (intmul1_rmorphism [comRingType of Fp])) -(map_J (intmul1_rmorphism rat_comRing)).
exact: proposition_1_4.
Qed.

(* A motion in numbers that all these pairs allow, and the pair of i and j does not: that pair raises the rank. *)
Section Motion.
Variable motion_of : nat -> nat.
Definition motion_u : motion := \matrix_v mxvec (\matrix_(h < 3, b < 4) (motion_of (key v h b))%:R).

Lemma coord_motion (v : 'I_n) (h : 'I_3) (b : 'I_4) : coord motion_u (key v h b) = (motion_of (key v h b))%:R.
Proof. by rewrite coord_key /cam rowK mxvecK mxE. Qed.

Lemma dot_lt y : (dot p motion_of y < p)%N.
Proof. by case: y => [|[k x] y] /=; rewrite ?ltn_mod prime_gt0. Qed.

Lemma dot_row (i j : 'I_n) (a b : 'I_4) :
  (dot p motion_of (combination 0%N (addp p) (mulp p) (oppp p) (cs i) (cs j) i j a b))%:R
  = equation (normal n csF) (i, j) motion_u a b.
Proof.
rewrite -row_sound /combination /eval !big_cons big_nil /=.
pose h0 : 'I_3 := ord0; pose h1 : 'I_3 := lift ord0 ord0; pose h2 : 'I_3 := lift ord0 (lift ord0 ord0).
have e (v : 'I_n) (c : 'I_4) := And3 (coord_motion v h0 c) (coord_motion v h1 c) (coord_motion v h2 c).
have [-> -> ->] := e i a; have [-> -> ->] := e i b; have [-> -> ->] := e j a; have [-> -> ->] := e j b.
by rewrite !addpE !mulpE.
Qed.

Lemma symmetric (R : comRingType) (P dP : cameras R n) e a b : equation P e dP a b = equation P e dP b a.
Proof. by rewrite [LHS]mxE [RHS]mxE [X in _ + X = _]mxE [X in _ = _ + X]mxE addrC. Qed.

Lemma solvedP (i j : 'I_n) : solved p cs motion_of i j entries10 = (equation (normal n csF) (i, j) motion_u == 0).
Proof.
have zero (a b : 'I_4) : eqn (dot p motion_of (combination 0%N (addp p) (mulp p) (oppp p) (cs i) (cs j) i j a b)) 0
    = (equation (normal n csF) (i, j) motion_u a b == 0).
  rewrite -dot_row -(dvdn_charf (char_Fp p_prime)); have := dot_lt (combination 0%N (addp p) (mulp p) (oppp p) (cs i) (cs j) i j a b).
  by case: dot => [|d] lt; rewrite ?dvdn0 // gtnNdvd.
pose o k : 'I_4 := inord k; have oE k : (k < 4)%N -> nat_of_ord (o k) = k by move=> ?; rewrite inordK.
have all_ab : solved p cs motion_of i j entries10 = all (fun ab => equation (normal n csF) (i, j) motion_u (o ab.1) (o ab.2) == 0) entries10.
  have : all (fun ab => (ab.1 < 4)%N && (ab.2 < 4)%N) entries10 by [].
  elim: entries10 => //= -[a b] L ih /andP [/andP [/= a4 b4] /ih <-].
  by have := zero (o a) (o b); rewrite !oE // => ->; case: eqP.
rewrite all_ab; apply/allP/eqP => [h | -> ab _]; last by rewrite mxE.
apply/matrixP=> a b; rewrite [RHS]mxE.
wlog ab : a b / (a <= b)%N.
  by move=> w; case: (leqP a b) => [|/ltnW] ab; [exact: w | rewrite symmetric; exact: w].
have /h /eqP : (val a, val b) \in entries10.
  by case: a b ab => [[|[|[|[|//]]]] ?] [[|[|[|[|//]]]] ?].
by rewrite /= /o !inord_val.
Qed.

Theorem motion_sound L (i j : 'I_n) r : (r <= \rank (J (edges n (pairs_of L)) (normal n csF)))%N ->
  all_solved p cs motion_of L -> ~~ solved p cs motion_of i j entries10 ->
  attained ((i, j) :: edges n (pairs_of L)) r.+1.
Proof.
move=> rL sol nij; apply: lifted; apply: leq_ltn_trans rL _.
set P := normal n csF; set E := edges n _; rewrite solvedP -/P in nij.
have EP : {subset E <= (i, j) :: E} by move=> e eE; rewrite inE eE orbT.
have sub := ker_mono P EP.
have uE : (mxvec motion_u <= kermx (J E P))%MS.
  rewrite J_kerP mxvecK; apply/allP=> -[x y]; rewrite mem_pmap => /mapP [[x' y'] /mapP [[[k l] mask] kL [-> ->]] /=].
  case: insubP => // x'' _ ex; case: insubP => // y'' _ ey [-> ->]; rewrite -solvedP ex ey.
  elim: L sol kL {E EP sub} => //= -[[k' l'] mask'] L ih; case: ifP => // kl /ih {}ih.
  by rewrite inE => /predU1P [[-> -> _]|/ih].
have nuE : ~~ (mxvec motion_u <= kermx (J ((i, j) :: E) P))%MS.
  by rewrite J_kerP mxvecK /= (negbTE nij).
have /rank_ltmx : (kermx (J ((i, j) :: E) P) < kermx (J E P))%MS.
  by rewrite ltmxE sub /=; apply: contra nuE; apply: submx_trans.
by rewrite !mxrank_ker; move: (\rank _) (\rank _) => r1 r2; lia.
Qed.
End Motion.
End Sound.
