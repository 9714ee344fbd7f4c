(* Section 5, hubs: a node that is several nodes of a split graph.

   The theorem is that of 5.2, proved in another way, without flows: the motions that it needs are written down. Each cell
   of the split graph moves as a whole, P_v X + mu_v P_v, where all X agree on the centre of the hub, and mu may differ
   from copy to copy; the count is of unknowns and of conditions that copies of the hub move as it does. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Generic NormalForm Counting.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.

(* ------------------------------------------------------------------ the program *)

(* Nodes of the split graph of s nodes: 0 .. s-1, of which 0 is the hub, and its copies s .. s + copies - 1. Cells are sets of
   them. Each node is the first one of those that hang together, or is in a cell with one of lower depth, at these places. *)
Record split := Split {
  copies : nat; cell_count : nat; cell_size : nat -> nat; cell_node : nat -> nat -> nat;
  link : nat -> option (nat * nat * nat); depth : nat -> nat }.
Definition origin (s x : nat) : nat := if x < s then x else 0.

Section Program.
Variables (s : nat) (H : split).
Fixpoint cell_nodes_ok (d k : nat) : bool :=
  if k is k'.+1 then if cell_node H d k' < s + copies H then cell_nodes_ok d k' else false else true.
(* what the cells before d count, if all are in order: the first two nodes of each are different nodes of the graph *)
Fixpoint cells_sum (d acc : nat) : option nat :=
  if d is d'.+1 then
    if 1 < cell_size H d' then
      if cell_nodes_ok d' (cell_size H d') then
        if eqn (origin s (cell_node H d' 0)) (origin s (cell_node H d' 1)) then None
        else cells_sum d' (9 * cell_size H d' + acc)
      else None
    else None
  else Some acc.
(* how many of the nodes before x are first ones *)
Fixpoint first_ones (x acc : nat) : option nat :=
  if x is x'.+1 then
    match link H x' with
    | None => first_ones x' acc.+1
    | Some (d, i, j) =>
      if d < cell_count H then
        if i < cell_size H d then
          if j < cell_size H d then
            if eqn (cell_node H d i) x' then
              if depth H (cell_node H d j) < depth H x' then first_ones x' acc else None
            else None
          else None
        else None
      else None
    end
  else Some acc.
Definition split_bound : option nat :=
  if 0 < s then
    if 0 < cell_count H then
      if cells_sum (cell_count H) 0 is Some a then
        if first_ones (s + copies H) 0 is Some r then Some (a + r + 3 * s - (s + copies H + 12 * cell_count H + 4))
        else None
      else None
    else None
  else None.
End Program.
Local Open Scope ring_scope.

(* ------------------------------------------------------------------ unknowns, conditions, and a kernel *)
Section Count.
Variables (F : fieldType) (U C R : vectType F) (p q : nat).
Variables (f : {linear U -> C}) (g : {linear U -> 'rV[F]_p}) (r : {linear U -> R}) (A : 'M[F]_(p, q)).

Lemma rank_by_vectors (W : {vspace 'rV[F]_p}) : (forall w, w \in W -> w *m A = 0) -> (\dim W + \rank A <= p)%N.
Proof.
move=> WA; pose M := \matrix_(i < \dim W) (vbasis W)`_i.
have free_M : row_free M.
  apply/inj_row_free=> x x0; apply/rowP=> i; rewrite mxE.
  have /freeP := basis_free (vbasisP W); apply; rewrite -[RHS]x0 mulmx_sum_row.
  by apply: eq_bigr => k _; rewrite rowK.
have MA : M *m A = 0.
  by apply/row_matrixP=> i; rewrite row_mul rowK row0 WA // vbasis_mem // mem_nth // size_tuple.
by have := mulmx0_rank_max MA; rewrite (eqP free_M).
Qed.

Lemma count_motions : (forall x, f x = 0 -> g x *m A = 0) -> (forall x, f x = 0 -> g x = 0 -> r x = 0 -> x = 0) ->
  (Vector.dim U + \rank A <= Vector.dim C + Vector.dim R + p)%N.
Proof.
move=> fg fgr; set K := lker (linfun f).
have inK x : x \in K -> f x = 0 by rewrite memv_ker lfunE => /eqP.
have e1 := limg_ker_dim (linfun f) fullv; have e2 := limg_ker_dim (linfun g) K.
have e3 := limg_ker_dim (linfun r) (K :&: lker (linfun g))%VS.
have z : (K :&: lker (linfun g) :&: lker (linfun r))%VS = 0%VS.
  apply/eqP; rewrite -subv0; apply/subvP=> x; rewrite !memv_cap !memv_ker memv0 !lfunE.
  by case/andP=> /andP [/eqP x1 /eqP x2] /eqP x3; rewrite (fgr x).
rewrite z dimv0 add0n in e3; rewrite capfv dimvf in e1.
have := dimvS (subvf (linfun f @: fullv)%VS); rewrite dimvf => d1.
have := dimvS (subvf (linfun r @: (K :&: lker (linfun g)))%VS); rewrite dimvf => d3.
have := @rank_by_vectors (linfun g @: K)%VS => /(_ _) d2.
have {}d2 : (\dim (linfun g @: K) + \rank A <= p)%N.
  by apply: d2 => _ /memv_imgP [x /inK x0 ->]; rewrite lfunE; apply: fg.
move: e1 e2 e3 d1 d2 d3; rewrite -/K.
move: (\dim K) (\dim (linfun f @: fullv)) (\dim (linfun g @: K)) (\dim (linfun r @: _)) (\dim (K :&: _)) => a b c d e.
lia.
Qed.
End Count.

Section Dim.
Variable F : fieldType.
Implicit Types U W : vectType F.
Lemma dim_mx m n : Vector.dim (matrix_vectType F m n) = (m * n)%N. Proof. by []. Qed.
Lemma dim_pair U W : Vector.dim (pair_vectType U W) = (Vector.dim U + Vector.dim W)%N. Proof. by []. Qed.
Lemma dim_ffun k U : Vector.dim (ffun_vectType [finType of 'I_k] U) = (k * Vector.dim U)%N.
Proof. by rewrite -[X in (X * _)%N](card_ord k). Qed.
End Dim.

(* ------------------------------------------------------------------ Lemma 2.1 (b) *)
Section Turn.
Variables (F : fieldType) (n : nat) (H : 'M[F]_4).
Implicit Types (P u : cameras F n) (E : seq ('I_n * 'I_n)).
Definition turned P : cameras F n := \matrix_v mxvec (cam P v *m H).
Lemma cam_turned P v : cam (turned P) v = cam P v *m H.
Proof. by rewrite /cam rowK mxvecK. Qed.

Lemma fund_turned (A B : 'M[F]_(3, 4)) : fund (A *m H) (B *m H) = \det H *: fund A B.
Proof.
apply/matrixP=> h k; rewrite !mxE mulrCA; congr (_ * _); rewrite mulrC -det_mulmx.
have e : col_mx (row' k (A *m H)) (row' h (B *m H)) = col_mx (row' k A) (row' h B) *m H.
  by rewrite mul_col_mx !row'Esub !mul_rowsub_mx.
exact: (congr1 (fun M : 'M_4 => \det M) e).
Qed.

Lemma equation_turned P u e : equation (turned P) e (turned u) = \det H *: (H^T *m equation P e u *m H).
Proof.
rewrite /equation !cam_turned fund_turned; move: (fund _ _) => G.
set S' := (cam P e.2)^T *m G *m _ + _; set S := _ + (_ *m (_ *: _)^T *m _).
have -> : S = \det H *: (H^T *m S' *m H).
  rewrite /S /S' [(_ *: G)^T]linearZ /= -!(scalemxAr, scalemxAl) -scalerDr; congr (_ *: _).
  by rewrite mulmxDr mulmxDl !trmx_mul !mulmxA.
move: S' {S} => S; rewrite [(_ *: _)^T]linearZ /= -scalerDr; congr (_ *: _).
by rewrite mulmxDr mulmxDl !trmx_mul trmxK !mulmxA.
Qed.

Lemma turned_is_linear : linear turned.
Proof. by move=> a P u; apply/row_matrixP=> v; rewrite [RHS]linearP /= !rowK camP mulmxDl -scalemxAl mxvecP. Qed.
Canonical turned_linear := Linear turned_is_linear.

Lemma J_turned E P : H \in unitmx -> (\rank (J E P) <= \rank (J E (turned P)))%N.
Proof.
move=> uH; apply: leq_trans (mxrankM_maxr (lin_mx turned) _).
apply: rank_by_ker; apply/rV_subP=> u /sub_kermxP; rewrite mulmxA => /eqP; rewrite J_ker J_kerP => /allP h.
apply/allP=> e /h; rewrite mul_rV_lin mxvecK equation_turned scaler_eq0.
have d0 : \det H != 0 by rewrite -unitfE -unitmxE.
rewrite (negbTE d0) /= => /eqP e0; apply/eqP.
have := congr1 (fun M => invmx H^T *m M *m invmx H) e0; rewrite mulmx0 mul0mx !mulmxA mulVmx ?unitmx_tr // mul1mx.
by rewrite -mulmxA mulmxV // mulmx1.
Qed.
End Turn.

(* ------------------------------------------------------------------ centres that are apart *)
Section Apart.
Variable n : nat.
Definition apart_det (R : comRingType) (P : cameras R n) (u v : 'I_n) : R :=
  \det (col_mx (cam P u) (row ord0 (cam P v)) : 'M_(3 + 1)).
Definition all_apart (R : comRingType) (P : cameras R n) : R := \prod_u \prod_(v | v != u) apart_det P u v.

Lemma map_apart (R S : comRingType) (f : {rmorphism R -> S}) (P : cameras R n) :
  f (all_apart P) = all_apart (map_mx f P : cameras S n).
Proof.
rewrite rmorph_prod; apply: eq_bigr => u _; rewrite rmorph_prod; apply: eq_bigr => v _.
by rewrite /apart_det -det_map_mx map_col_mx map_row !map_cam.
Qed.

Section Field.
Variable F : fieldType.
Implicit Types P : cameras F n.

Lemma all_apartP P : all_apart P != 0 -> forall u v, u != v -> apart_det P u v != 0.
Proof. by move=> /prodf_neq0 h u v uv; have /prodf_neq0 := h u isT; apply; rewrite eq_sym. Qed.

Lemma apart_turned P H : H \in unitmx -> all_apart P != 0 -> all_apart (turned H P) != 0.
Proof.
rewrite unitmxE unitfE => dH /all_apartP h; apply/prodf_neq0 => u _; apply/prodf_neq0 => v vu.
by rewrite /apart_det !cam_turned row_mul -mul_col_mx det_mulmx mulf_neq0 ?h // eq_sym.
Qed.

(* two cameras: what moves neither of them is nothing *)
Lemma apart_two P u v (X : 'M_4) b : all_apart P != 0 -> u != v ->
  cam P u *m X = 0 -> cam P v *m X = b *: cam P v -> X = 0 /\ b = 0.
Proof.
move=> /all_apartP ap uv Xu Xv; pose D : 'M_(3 + 1, 4) := col_mx (cam P u) (row ord0 (cam P v)).
have uD : (D : 'M_4) \in unitmx by rewrite unitmxE unitfE; apply: ap.
have DX : D *m X = col_mx 0 (b *: row ord0 (cam P v)).
  by rewrite /D mul_col_mx Xu -row_mul Xv linearZ.
have full : row_free (cam P v).
  have uD' : (col_mx (cam P v) (row ord0 (cam P u)) : 'M_(3 + 1, 4)) \in unitmx.
    by rewrite unitmxE unitfE; apply: ap; rewrite eq_sym.
  have /row_free_inj inj : row_free (col_mx (cam P v) (row ord0 (cam P u)) : 'M_(3 + 1, 4)) by rewrite row_free_unit.
  apply/inj_row_free=> x x0; have := @inj _ (row_mx x 0) 0.
  by rewrite mul_row_col x0 !mul0mx addr0 => /(_ erefl) /(congr1 lsubmx); rewrite row_mxKl linear0.
have b0 : b = 0.
  apply/eqP; apply: contraT => nb; have r3 : \rank (cam P v *m X) = 3%N by rewrite Xv mxrank_scale_nz ?(eqP full).
  have rX : \rank X = \rank (D *m X) by rewrite (eqmxMfull _ _) // row_full_unit.
  have := mxrankM_maxr (cam P v) X; rewrite r3 rX DX rank_col_0mx => /leq_trans/(_ (mxrankS (scalemx_sub b (submx_refl _)))).
  by move/leq_trans/(_ (rank_leq_row _)).
split=> //; have := DX; rewrite b0 scale0r col_mx0 => /(congr1 (mulmx (invmx D))).
by rewrite mulmx0 mulKmx.
Qed.
Lemma apart_nonzero P (u v w : 'I_n) : all_apart P != 0 -> u != v -> cam P w != 0.
Proof.
move=> /all_apartP ap uv; have [z wz] : exists z, w != z.
  by case: (eqVneq w u) => [->|]; [exists v | exists u].
have := ap w z wz; apply: contraNneq => w0; rewrite /apart_det w0.
rewrite (expand_det_row _ (lshift 1 (ord0 : 'I_3))) big1 // => j _.
by rewrite col_mxEu mxE mul0r.
Qed.
End Field.

(* some cameras are *)
Lemma some_apart (F : numFieldType) : exists P : cameras F n, all_apart P != 0.
Proof.
pose c v k : F := (v * (k == 0%N))%:R; exists (normal n c).
apply/prodf_neq0 => u _; apply/prodf_neq0 => v vu; rewrite /apart_det !cam_normal.
pose g r := if (r < 3)%N then normal_entry c u r else normal_entry c v 0.
have -> : col_mx (mx 3 4 (normal_entry c u)) (row ord0 (mx 3 4 (normal_entry c v))) = mx 4 4 g.
  apply/matrixP=> i j; rewrite !mxE; case: split_ordP => k ->; rewrite !mxE /g /=; first by rewrite ltn_ord.
  by [].
rewrite det4E; have -> : det4 g = u%:R - v%:R.
  rewrite /det4 /det3 /det2 /minor /g /normal_entry /bump /c /= !muln0 !muln1.
  by move: (u%:R : F) (v%:R : F) => x y; ring.
by rewrite subr_eq0 eqr_nat; apply: contra vu => /eqP e; apply/eqP/val_inj.
Qed.
End Apart.

(* ------------------------------------------------------------------ Theorem 5.2 *)
Section Hub.
Variables (F : numFieldType) (k q : nat) (proj : 'I_q -> 'I_k) (lift_ : 'I_k -> 'I_q) (h : 'I_k).
(* A node of the graph other than the hub is one node of the split graph. *)
Hypothesis lift_proj : forall x, proj x != h -> lift_ (proj x) = x.
Variables (cells : seq (seq 'I_q)) (roots : seq 'I_q).
Hypothesis some_cell : (0 < size cells)%N.
Hypothesis two_nodes : forall B, B \in cells -> forall v, exists2 y, y \in B & proj y != v.
(* Every node hangs together with a root. *)
Hypothesis connected : forall A : pred 'I_q, {subset roots <= A} ->
  (forall B, B \in cells -> forall x y, x \in B -> y \in B -> A x -> A y) -> forall x, A x.
Notation b := (size cells).
Definition members : seq ('I_b * 'I_q) := [seq (i, x) | i <- enum 'I_b, x <- nth [::] cells (i : 'I_b)].
Notation c := (size members).
Notation rr := (size roots).

Section At.
Variable P : cameras F k.
Notation left v := (lsubmx (cam P v : 'M_(3, 3 + 1))).
Notation right v := (rsubmx (cam P v : 'M_(3, 3 + 1))).
Hypotheses (ap : all_apart P != 0) (hub_at : right h = 0).

(* scales; three columns of X for every cell, and the fourth one, which all share; three columns of dP *)
Definition unknowns : vectType F :=
  [vectType F of 'rV[F]_q * {ffun 'I_b -> 'M[F]_(4, 3)} * 'cV[F]_4 * {ffun 'I_k -> 'M[F]_3}].
Definition scale (u : unknowns) x : F := u.1.1.1 0 x.
Definition X3 (u : unknowns) i : 'M[F]_(4, 3) := u.1.1.2 i.
Definition X1 (u : unknowns) : 'cV[F]_4 := u.1.2.
Definition dP3 (u : unknowns) v : 'M[F]_3 := u.2 v.
Lemma scaleP a (u w : unknowns) x : scale (a *: u + w) x = a * scale u x + scale w x.
Proof. by rewrite /scale !mxE. Qed.
Lemma X3P a (u w : unknowns) i : X3 (a *: u + w) i = a *: X3 u i + X3 w i.
Proof. by rewrite /X3 !ffunE. Qed.
Lemma X1P a (u w : unknowns) : X1 (a *: u + w) = a *: X1 u + X1 w.
Proof. by []. Qed.
Lemma dP3P a (u w : unknowns) v : dP3 (a *: u + w) v = a *: dP3 u v + dP3 w v.
Proof. by rewrite /dP3 !ffunE. Qed.

Lemma both_linear (p r s : nat) a (A : 'M[F]_(p, r)) (X Y : 'M_(r, s)) (B : 'M_(p, s)) x y :
  A *m (a *: X + Y) + (a * x + y) *: B = a *: (A *m X + x *: B) + (A *m Y + y *: B).
Proof. by rewrite mulmxDr -scalemxAr scalerDl -scalerA addrACA -scalerDr. Qed.

Lemma row_mx_linear (p r s : nat) a (A A' : 'M[F]_(p, r)) (B B' : 'M_(p, s)) :
  row_mx (a *: A + A') (a *: B + B') = a *: row_mx A B + row_mx A' B'.
Proof. by rewrite scale_row_mx add_row_mx. Qed.

Lemma row_mx_moves (p r s : nat) (Q : 'M[F]_(p, r + s)) (Y : 'M_(r + s, r)) (Z : 'M_(r + s, s)) a :
  row_mx (Q *m Y + a *: lsubmx Q) (Q *m Z + a *: rsubmx Q) = Q *m row_mx Y Z + a *: Q.
Proof.
have -> : a *: Q = row_mx (a *: lsubmx Q) (a *: rsubmx Q) by rewrite -scale_row_mx hsubmxK.
by rewrite mul_mx_row add_row_mx.
Qed.

(* all nodes of a cell move by its X *)
Definition condition (u : unknowns) (e : 'I_b * 'I_q) : 'M[F]_3 :=
  dP3 u (proj e.2) - (cam P (proj e.2) *m X3 u e.1 + scale u e.2 *: left (proj e.2)).
Definition conditions (u : unknowns) : {ffun 'I_c -> 'M[F]_3} := [ffun t => condition u (tnth (in_tuple members) t)].
Lemma conditions_linear : linear conditions.
Proof.
move=> a u w; apply/ffunP=> t; rewrite !ffunE /condition dP3P X3P scaleP both_linear.
by rewrite scalerBr addrACA -opprD.
Qed.
Definition motion (u : unknowns) : cameras F k :=
  \matrix_v mxvec (row_mx (dP3 u v) (cam P v *m X1 u + scale u (lift_ v) *: right v) : 'M_(3, 3 + 1)).
Lemma motion_linear : linear (fun u => mxvec (motion u)).
Proof.
move=> a u w; rewrite -mxvecP; congr mxvec; apply/row_matrixP=> v; rewrite [RHS]linearP /= !rowK -mxvecP; congr mxvec.
rewrite dP3P X1P scaleP both_linear.
exact: (@row_mx_linear 3 3 1).
Qed.
Definition at_roots (u : unknowns) : 'rV[F]_rr := \row_t scale u (tnth (in_tuple roots) t).
Lemma at_roots_linear : linear at_roots.
Proof. by move=> a u w; apply/rowP=> t; rewrite !mxE scaleP. Qed.

Definition X u i : 'M[F]_4 := row_mx (X3 u i) (X1 u).
Lemma membersE i x : (i, x) \in members = (x \in nth [::] cells i).
Proof.
apply/allpairsPdep/idP => [[j [y [_ yB [-> ->]]]] // | xB].
by exists i, x; rewrite mem_enum.
Qed.

Lemma motionE u v : cam (motion u) v = row_mx (dP3 u v) (cam P v *m X1 u + scale u (lift_ v) *: right v).
Proof. by rewrite /cam rowK mxvecK. Qed.

Lemma conditionsP u : conditions u = 0 -> forall i x, x \in nth [::] cells (i : 'I_b) ->
  cam (motion u) (proj x) = cam P (proj x) *m X u i + scale u x *: cam P (proj x).
Proof.
move=> u0 i x xB; rewrite motionE; set v := proj x.
have -> : dP3 u v = cam P v *m X3 u i + scale u x *: left v.
  have /tnthP [t et] : (i, x) \in in_tuple members by rewrite membersE.
  have := congr1 (fun y : {ffun 'I_c -> 'M[F]_3} => y t) u0; rewrite !ffunE /condition -et /= -/v => /eqP.
  by rewrite subr_eq0 => /eqP.
have -> : scale u (lift_ v) *: right v = scale u x *: right v.
  by case: (eqVneq v h) => [-> | /lift_proj ->//]; rewrite hub_at !scaler0.
exact: (@row_mx_moves 3 3 1).
Qed.

Lemma motion_kernel E u : all (fun e => has (fun B => (e.1 \in map proj B) && (e.2 \in map proj B)) cells) E ->
  conditions u = 0 -> mxvec (motion u) *m J E P = 0.
Proof.
move=> /allP cov u0; apply/eqP; rewrite J_ker mxvecK; apply/allP=> -[e1 e2] /cov /hasP [B BC] /=.
case/andP=> /mapP [x xB ->] /mapP [y yB ->].
have iB : (index B cells < b)%N by rewrite index_mem.
pose i := Ordinal iB; have Bi : nth [::] cells i = B by rewrite nth_index.
apply/eqP/(@equation_trivial _ _ _ _ (proj x, proj y) (X u i) (scale u x) (scale u y));
  by apply: conditionsP; rewrite ?Bi.
Qed.

Lemma motion_injective u : conditions u = 0 -> mxvec (motion u) = 0 -> at_roots u = 0 -> u = 0.
Proof.
move=> u0 /eqP; rewrite mxvec_eq0 => /eqP m0 r0.
have X0 (i : 'I_b) x : x \in nth [::] cells i -> cam P (proj x) *m X u i = - scale u x *: cam P (proj x).
  move/(conditionsP u0)/eqP; rewrite m0 /cam !linear0 eq_sym addr_eq0 => /eqP ->.
  by rewrite scaleNr.
have cellX (i : 'I_b) x : x \in nth [::] cells i -> scale u x = 0 ->
    X u i = 0 /\ forall y, y \in nth [::] cells i -> scale u y = 0.
  move=> xB x0; have BC : nth [::] cells i \in cells by apply: mem_nth.
  have Xx : cam P (proj x) *m X u i = 0 by rewrite X0 // x0 oppr0 scale0r.
  have [y yB yx] := two_nodes BC (proj x).
  rewrite eq_sym in yx; have [Xi _] := apart_two ap yx Xx (X0 _ _ yB).
  split=> // z zB; have := X0 i z zB; rewrite Xi mulmx0 => /esym/eqP.
  by rewrite scaler_eq0 oppr_eq0 (negbTE (apart_nonzero (proj z) ap yx)) orbF => /eqP.
have s0 : forall x, scale u x == 0.
  apply: connected => [x xr | B BC x y xB yB /eqP x0].
    have /tnthP [t ->] : x \in in_tuple roots by [].
    by apply/eqP; have := congr1 (fun w : 'rV_rr => w 0 t) r0; rewrite !mxE.
  have iB : (index B cells < b)%N by rewrite index_mem.
  by apply/eqP; have [|_] := cellX (Ordinal iB) x _ x0; rewrite /= nth_index // => /(_ _ yB).
have Xi i : X u i = 0.
  have BC : nth [::] cells (i : 'I_b) \in cells by apply: mem_nth.
  have [x xB _] := two_nodes BC h.
  by have [] := cellX i x xB (eqP (s0 x)).
have X3i i : X3 u i = 0 by have := congr1 (fun M : 'M_(4, 3 + 1) => lsubmx M) (Xi i); rewrite /X row_mxKl linear0.
have X1i : X1 u = 0 by have := congr1 (fun M : 'M_(4, 3 + 1) => rsubmx M) (Xi (Ordinal some_cell)); rewrite /X row_mxKr linear0.
have d0 v : dP3 u v = 0.
  have := motionE u v; rewrite m0 /cam !linear0 => /(congr1 (fun M : 'M_(3, 3 + 1) => lsubmx M)).
  by rewrite row_mxKl linear0.
case: u u0 m0 r0 {X0 cellX Xi} s0 X3i X1i d0 => [[[u1 u2] u3] u4] _ _ _ /= s0 X3i X1i d0.
congr (_, _, _, _).
- by apply/rowP=> x; rewrite mxE; apply/eqP/s0.
- by apply/ffunP=> i; rewrite ffunE; apply: X3i.
- exact: X1i.
- by apply/ffunP=> v; rewrite ffunE; apply: d0.
Qed.

Lemma size_members : c = (\sum_(B <- cells) size B)%N.
Proof.
rewrite size_allpairs_dep sumnE big_map big_enum /=.
by rewrite (big_nth [::]) big_mkord; apply: eq_bigr.
Qed.

Lemma hub_here E : all (fun e => has (fun B => (e.1 \in map proj B) && (e.2 \in map proj B)) cells) E ->
  (\rank (J E P) + (q + 12 * b + 4) <= 9 * (\sum_(B <- cells) size B) + size roots + 3 * k)%N.
Proof.
move=> cov; have := @count_motions F unknowns [vectType F of {ffun 'I_c -> 'M[F]_3}] [vectType F of 'rV[F]_rr] _ _
  (Linear conditions_linear) (Linear motion_linear) (Linear at_roots_linear) (J E P).
move=> /(_ (fun u => motion_kernel cov) motion_injective).
rewrite -size_members.
have -> : Vector.dim unknowns = (q + 12 * b + 4 + 9 * k)%N.
  by rewrite !dim_pair !dim_ffun !dim_mx; lia.
have -> : Vector.dim [vectType F of {ffun 'I_c -> 'M[F]_3}] = (9 * c)%N.
  by rewrite dim_ffun dim_mx; lia.
have -> : Vector.dim [vectType F of 'rV[F]_rr] = rr by rewrite dim_mx mul1n.
lia.
Qed.
End At.

Theorem theorem_5_2 E (P : cameras F k) :
  all (fun e => has (fun B => (e.1 \in map proj B) && (e.2 \in map proj B)) cells) E ->
  (\rank (J E P) + (q + 12 * b + 4) <= 9 * (\sum_(B <- cells) size B) + size roots + 3 * k)%N.
Proof.
move=> cov; have [P1 ap1] := some_apart k F.
have [||Q [r0 r1]] := @both F _ _ _ _ _ _ (fun R U => J E U) (fun R U => (all_apart U)%:M : 'M_1) P P1.
- by move=> t; rewrite map_J.
- by move=> t; rewrite map_scalar_mx map_apart.
have apQ : all_apart Q != 0.
  move: r1; rewrite -(scalemx1 _ (all_apart P1)) -(scalemx1 _ (all_apart Q)).
  by rewrite mxrank_scale_nz // mxrank1; apply: contraTneq => ->; rewrite scale0r mxrank0.
pose H := invmx (row_ebase (cam Q h)); have uH : H \in unitmx by rewrite unitmx_inv row_ebase_unit.
apply: leq_trans (hub_here (P := turned H Q) _ _ cov); first by rewrite leq_add2r; apply: leq_trans r0 (J_turned _ _ uH).
  exact: apart_turned.
rewrite cam_turned -[in X in X *m _](mulmx_ebase (cam Q h)) /H mulmxK ?row_ebase_unit //.
apply/matrixP=> i j; rewrite !mxE big1 // => x _; rewrite !mxE /=.
have -> : (x == 3 + j :> nat)%N = false by apply/negbTE; rewrite neq_ltn (leq_trans (ltn_ord x)) ?leq_addr.
by rewrite mulr0.
Qed.
End Hub.

(* ------------------------------------------------------------------ soundness of the program *)
Section Sound.
Variables (s : nat) (H : split).
Local Open Scope nat_scope.
Lemma cells_sumP d acc a : cells_sum s H d acc = Some a ->
  (forall i, i < d -> [/\ 1 < cell_size H i, forall x, x < cell_size H i -> cell_node H i x < s + copies H
     & origin s (cell_node H i 0) != origin s (cell_node H i 1)])
  /\ a = 9 * (\sum_(i <- iota 0 d) cell_size H i) + acc.
Proof.
elim: d acc => [|d ih] acc; first by move=> [<-]; split=> //; rewrite big_nil.
rewrite [cells_sum _ _ _ _]/=; case: ifP => // s1; case: ifP => // ok; case: eqnP => // ne /ih [lt ->]; split.
  move=> i; rewrite ltnS leq_eqVlt => /predU1P [-> | /lt //]; split=> //; last exact/eqP.
  elim: (cell_size H d) ok => //= k ihk; case: ifP => // kq /ihk {}ihk x.
  by rewrite ltnS leq_eqVlt => /predU1P [-> | /ihk].
by rewrite -[d.+1]addn1 iotaD big_cat big_seq1 /= add0n; lia.
Qed.

Lemma first_onesP x acc r : first_ones H x acc = Some r ->
  r = size [seq y <- iota 0 x | ~~ link H y] + acc /\
  forall y d i j, y < x -> link H y = Some (d, i, j) ->
    [/\ d < cell_count H, i < cell_size H d, j < cell_size H d, cell_node H d i = y & depth H (cell_node H d j) < depth H y].
Proof.
elim: x acc => [|x ih] acc; first by move=> [<-].
have -> : iota 0 x.+1 = iota 0 x ++ [:: x] by rewrite -addn1 iotaD.
rewrite filter_cat size_cat [first_ones _ _ _]/=.
case e: (link H x) => [[[d i] j]|] /=; rewrite ?e /=.
  case: ifP => // dc; case: ifP => // ic; case: ifP => // jc; case: eqnP => // xe; case: ifP => // dd /ih [-> lk].
  split=> [|y d' i' j']; first by rewrite addn0.
  by rewrite ltnS leq_eqVlt => /predU1P [-> | /lk h /h //]; rewrite e => -[<- <- <-].
move=> /ih [-> lk]; split=> [|y d i j]; first by rewrite addn1 addSnnS.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /lk h /h //]; rewrite e.
Qed.

Theorem split_boundP u n (node : nat -> 'I_n) (F : numFieldType) (P : cameras F n) E : split_bound s H = Some u ->
  all (fun e => has (fun d => inside (mkseq (fun i => node (origin s (cell_node H d i))) (cell_size H d)) e)
    (iota 0 (cell_count H))) E -> \rank (J E P) <= u.
Proof.
rewrite /split_bound; case: ifP => // s0; case: ifP => // c0; case ea: cells_sum => [a|//]; case er: first_ones => [r|//] [<-] cov.
have [cell ->] := cells_sumP ea; have [-> lk] := first_onesP er; rewrite !addn0 => {ea er}.
pose q := s + copies H; have q0 : 0 < q by rewrite addn_gt0 s0.
pose h : 'I_s := Ordinal s0; pose o : 'I_q := Ordinal q0.
pose proj (x : 'I_q) : 'I_s := insubd h (val x); pose up : 'I_s -> 'I_q := lshift (copies H).
have valproj x : val (proj x) = origin s (val x) by rewrite val_insubd.
pose cells := [seq mkseq (fun i => insubd o (cell_node H d i)) (cell_size H d) | d <- iota 0 (cell_count H)].
pose roots := [seq x : 'I_q <- enum 'I_q | ~~ link H x].
have valcell d i : d < cell_count H -> i < cell_size H d -> val (insubd o (cell_node H d i)) = cell_node H d i.
  by move=> /cell [_ lt _] /lt ltq; rewrite val_insubd ltq.
pose fits (e : 'I_s * 'I_s) := has (fun B => (e.1 \in map proj B) && (e.2 \in map proj B)) cells.
pose E0 := [seq e : 'I_s * 'I_s <- enum {: 'I_s * 'I_s} | fits e].
have EE : {subset E <= moved (fun i : 'I_s => node i) E0}.
  move=> -[x y] /(allP cov) /hasP [d]; rewrite mem_iota add0n => /= dc.
  rewrite /inside /= => /andP [/mapP [i + ->] /mapP [j + ->]]; rewrite !mem_iota !add0n => /= ic jc.
  apply/mapP; exists (proj (insubd o (cell_node H d i)), proj (insubd o (cell_node H d j))); last by rewrite !valproj !valcell.
  rewrite mem_filter mem_enum andbT; apply/hasP; exists (mkseq (fun i => insubd o (cell_node H d i)) (cell_size H d)).
    by apply: map_f; rewrite mem_iota.
  by apply/andP; split; apply/map_f/map_f; rewrite mem_iota.
apply: leq_trans (J_mono P EE) _; apply: leq_trans (J_local _ _ _) _.
have lu x : proj x != h -> up (proj x) = x.
  move=> xh; apply: val_inj; rewrite /= -[nat_of_ord _]/(val (proj x)) valproj; move: xh.
  by rewrite -val_eqE valproj /origin; case: ifP.
have sc : size cells = cell_count H by rewrite size_map size_iota.
have two B : B \in cells -> forall v, exists2 y, y \in B & proj y != v.
  case/mapP=> d; rewrite mem_iota add0n => /= dc -> v; have [s2 _ ne] := cell d dc.
  have m i : i < 2 -> insubd o (cell_node H d i) \in mkseq (fun i => insubd o (cell_node H d i)) (cell_size H d).
    by move=> i2; apply: map_f; rewrite mem_iota add0n /= (leq_trans i2).
  case: (eqVneq (proj (insubd o (cell_node H d 0))) v) => [e | ne0].
    exists (insubd o (cell_node H d 1)); first exact: m.
    rewrite -e -val_eqE !valproj !valcell //; last exact: ltnW.
    by rewrite eq_sym.
  by exists (insubd o (cell_node H d 0)); first exact: m.
have con (A : pred 'I_q) : {subset roots <= A} ->
  (forall B, B \in cells -> forall x y, x \in B -> y \in B -> A x -> A y) -> forall x, A x.
  move=> rA cA x; have [k le] := ubnP (depth H x); elim: k x le => // k ih x le.
  case e: (link H x) => [[[d i] j]|]; last by apply: rA; rewrite mem_filter mem_enum e.
  have [dc ic jc xe dd] := lk _ _ _ _ (ltn_ord x) e.
  apply: (cA (mkseq (fun i => insubd o (cell_node H d i)) (cell_size H d)) _ (insubd o (cell_node H d j))).
  - by apply: map_f; rewrite mem_iota.
  - by apply: map_f; rewrite mem_iota.
  - have -> : x = insubd o (cell_node H d i) by apply: val_inj; rewrite valcell.
    by apply: map_f; rewrite mem_iota.
  - by apply: ih; rewrite valcell //; apply: leq_trans dd _.
have := @theorem_5_2 F s q proj up h lu cells roots _ two con E0 (rowsub (fun i : 'I_s => node i) P).
rewrite sc => /(_ c0)/(_ (filter_all _ _)).
have -> : \sum_(B <- cells) size B = \sum_(i <- iota 0 (cell_count H)) cell_size H i.
  by rewrite big_map; apply: eq_bigr => d _; rewrite size_mkseq.
have -> : size roots = size [seq y <- iota 0 q | ~~ link H y] by rewrite -val_enum_ord filter_map size_map.
by rewrite /q; move: (\rank _) (\sum_(i <- _) _) => x y; lia.
Qed.
End Sound.
