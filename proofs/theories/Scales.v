(* Section 10: scales that are settled by linear algebra (Theorem 10.6). If all solutions have the scale 1 on some links between
   nodes, forms that say the same of all their cameras have a rank that shows it of one more, and at last that all cameras
   are the same up to one projectivity.

   A link is a pair of nodes that are in a pair or in a body that is uniquely determined, or two nodes each of which is in one with a third
   node (Lemma 10.4). Here no node is eliminated, and no scale is a number: nodes have their factors along a tree of links,
   and links are known, or not yet, to have scale 1. *)
From mathcomp Require Import all_ssreflect all_algebra zify ring.
From Viewcert Require Import Statement Skew Motions Differential Generic NormalForm Rigid Elimination Checker Generically Unique.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.
Import GRing.Theory Num.Theory.

(* ------------------------------------------------------------------ the program *)
(* Why the scales of two nodes can be compared: both are in a pair or a body, and which coordinate of its planes is looked at;
   or each of them is with a third node, and it is the plane of all three. *)
Inductive via := Direct of nat & reason | Middle of nat & reason & reason.
Record link := Link { from : nat; to : nat; by_ : via }.
(* the row of a link, or one side of it *)
Inductive form := Whole of link | From of link | To of link.
(* The first of some links has scale 1, as the rank with all of them freed shows; or two nodes do, as they do with a third one *)
Inductive step := Settle of link & seq link | Corner of nat & nat & nat & reason.
Definition demand := (seq form * nat)%type.

Section Program.
Variables (n : nat) (allowed : nat -> nat -> reason -> bool) (C : nat) (node_at : nat -> nat).
Definition link_ok (l : link) : bool :=
  if from l < C then
    if to l < C then
      match by_ l with
      | Direct a why => if a < 4 then allowed (node_at (from l)) (node_at (to l)) why else false
      | Middle v why why' =>
        if v < n then if allowed (node_at (from l)) v why then allowed v (node_at (to l)) why' else false else false
      end
    else false
  else false.
Fixpoint links_ok (L : seq link) : bool := if L is l :: L' then if link_ok l then links_ok L' else false else true.

(* all rows of a link *)
Definition learn (l : link) (known : seq link) : seq link :=
  match by_ l with
  | Direct _ why => Link (from l) (to l) (Direct 0 why) :: Link (from l) (to l) (Direct 1 why)
      :: Link (from l) (to l) (Direct 2 why) :: known
  | _ => l :: known
  end.
Definition is_tie i j (l : link) : bool :=
  match by_ l with
  | Direct _ _ => if eqn (from l) i then eqn (to l) j else if eqn (from l) j then eqn (to l) i else false
  | _ => false
  end.
Fixpoint tie_in i j (known : seq link) : bool :=
  if known is l :: known' then if is_tie i j l then true else tie_in i j known' else false.

Fixpoint wholes (known : seq link) : seq form := if known is l :: known' then Whole l :: wholes known' else [::].
Fixpoint sides (L : seq link) (tail : seq form) : seq form :=
  if L is l :: L' then From l :: To l :: sides L' tail else tail.
Fixpoint count (L : seq link) : nat := if L is _ :: L' then (count L').+1 else 0.

(* node k > 0 of the core hangs on one before it; nodes 0 and 1 are a pair or in a body *)
Fixpoint tree_ok (tree : nat -> link) (k : nat) : bool :=
  if k is k'.+1 then
    if k' is 0 then true
    else if eqn (to (tree k')) k' then
      if from (tree k') < k' then if link_ok (tree k') then tree_ok tree k' else false else false
    else false
  else true.
Fixpoint hanging (tree : nat -> link) (k : nat) : seq link :=
  if k is k'.+1 then if k' is 0 then [::] else learn (tree k') (hanging tree k') else [::].

(* what the steps need of ranks: some forms have this one at least, less 4 *)
Fixpoint demands (known : seq link) (steps : seq step) : option (seq demand) :=
  match steps with
  | [::] => Some [:: (wholes known, 3 * C)]
  | Settle l L :: steps' =>
    if links_ok (l :: L) then
      if demands (learn l known) steps' is Some D then Some ((To l :: sides L (wholes known), 3 * C + count (l :: L)) :: D)
      else None
    else None
  | Corner i j k why :: steps' =>
    if tie_in i j known then
      if tie_in j k known then
        if link_ok (Link i k (Direct 0 why)) then
          if eqn i j then None
          else if eqn i k then None
          else if eqn j k then None
          else demands (learn (Link i k (Direct 0 why)) known) steps'
        else None
      else None
    else None
  end.

(* forms at centres, as rows with columns 3 s + h *)
Variables (p : nat) (cs : nat -> nat -> nat).
Notation addp := (addp p).
Notation mulp := (mulp p).
Notation oppp := (oppp p).
Definition plane_entry (l : link) h : nat :=
  let i := node_at (from l) in let j := node_at (to l) in
  let M a := M_entry 0 addp mulp oppp (cs i) (cs j) a h in
  match by_ l with
  | Direct a _ => M a
  | Middle v _ _ => addp (mulp (cs v 0) (M 0)) (addp (mulp (cs v 1) (M 1)) (addp (mulp (cs v 2) (M 2)) (M 3)))
  end.
Definition from_row (l : link) : sparse :=
  [:: (3 * from l, plane_entry l 0); (3 * from l + 1, plane_entry l 1); (3 * from l + 2, plane_entry l 2)].
Definition to_row (l : link) : sparse :=
  [:: (3 * to l, oppp (plane_entry l 0)); (3 * to l + 1, oppp (plane_entry l 1)); (3 * to l + 2, oppp (plane_entry l 2))].
Definition form_row (f : form) : sparse :=
  match f with Whole l => from_row l ++ to_row l | From l => from_row l | To l => to_row l end.
Fixpoint form_rows (L : seq form) : seq sparse := if L is f :: L' then form_row f :: form_rows L' else [::].

Fixpoint all_shown (D : seq demand) : bool :=
  if D is (L, r) :: D' then if r <= size (pivots_of p (3 * C) (form_rows L)) + 4 then all_shown D' else false else true.
End Program.

Local Open Scope ring_scope.
(* ------------------------------------------------------------------ Theorem 10.6 *)
(* The columns of cameras P and Q, for which forms A and B say the same and the same up to factors s. *)
Section Forms.
Variables (F : fieldType) (N : nat) (p q : 'M[F]_(4, N)).
Hypotheses (pfree : row_free p) (qfree : row_free q).

Lemma col_mul m k t (X : 'M[F]_(m, k)) (Y : 'M_(k, t)) g : col g (X *m Y) = X *m col g Y.
Proof. by rewrite !colE mulmxA. Qed.
Lemma kernel_rank k t (B : 'M[F]_(N, k)) (T : 'M_(N, t)) (u : 'M_(4, N)) : row_free u ->
  kermx (u *m B) *m u *m T = 0 -> (N + k <= \rank T + 4)%N ->
  row_full (u *m B) /\ (\rank (kermx T) <= \rank (kermx (u *m B) *m u))%N.
Proof.
move=> ufree /sub_kermxP /mxrankS; rewrite (mxrankMfree _ ufree) /row_full !mxrank_ker.
have := rank_leq_row T; have := rank_leq_col (u *m B); have := rank_leq_row (u *m B).
by move: (\rank T) (\rank (u *m B)) => x y; clear; split; lia.
Qed.

Theorem settled k t (A B : 'M[F]_(N, k)) (T : 'M_(N, t)) (s : 'I_k -> F) h :
  p *m A = p *m B -> (forall g, col g (q *m A) = s g *: col g (q *m B)) ->
  (forall x x' : 'rV_4, (x *m q + x' *m p) *m B = 0 -> (forall g, g != h -> col g ((x *m q + x' *m p) *m A) = 0) ->
    (x *m q + x' *m p) *m T = 0) ->
  (N + k <= \rank T + 4)%N -> s h = 1.
Proof.
move=> pAB qAB inT rT; set ZP := kermx (p *m B); set ZQ := kermx (q *m B).
have pZ (x : 'rV_4) : x *m (p *m B) = 0 -> x *m p *m T = 0.
  move=> x0; have := inT 0 x; rewrite mul0mx add0r; apply=> [|g _]; first by rewrite -mulmxA.
  by rewrite -mulmxA pAB x0 col0.
have qZ (x : 'rV_4) : x *m (q *m B) = 0 -> x *m q *m T = 0.
  move=> x0; have := inT x 0; rewrite mul0mx addr0; apply=> [|g _]; first by rewrite -mulmxA.
  by rewrite -mulmxA col_mul qAB -scalemxAr -col_mul x0 col0 scaler0.
have rows (u : 'M[F]_(4, N)) : (forall x : 'rV_4, x *m (u *m B) = 0 -> x *m u *m T = 0) -> kermx (u *m B) *m u *m T = 0.
  move=> uZ; have := mulmx_ker (u *m B); move: (kermx _) => K K0.
  by apply/row_matrixP=> i; rewrite row0 !row_mul; apply: uZ; rewrite -row_mul K0 row0.
have pT := rows p pZ; have qT := rows q qZ.
have [/row_fullP [V VB] le] := kernel_rank pfree pT rT.
have [/row_fullP [U UB] _] := kernel_rank qfree qT rT.
have kT : (kermx T <= ZP *m p)%MS.
  by rewrite -(geq_leqif (mxrank_leqif_sup _)) //; apply/sub_kermxP.
pose y := row h U *m q + (- row h V) *m p.
have yB : y *m B = 0 by rewrite mulmxDl mulNmx mulNmx -!mulmxA -!row_mul UB VB subrr.
have yA g : col g (y *m A) = (s g - 1) *: ((g == h)%:R)%:M.
  rewrite mulmxDl linearD /= !mulNmx -!mulmxA pAB col_mul qAB -scalemxAr linearN /= -col_mul -!row_mul UB VB.
  apply/matrixP=> i j; rewrite !ord1 !mxE eqxx mulr1n [h == g]eq_sym; case: (g == h) => /=; ring.
have : y *m T = 0.
  by apply: inT => // g gh; rewrite yA (negbTE gh) raddf0 scaler0.
have := mulmx_ker (p *m B); move: kT; rewrite /ZP; move: (kermx (p *m B)) => Z kT Z0.
move/sub_kermxP => /submx_trans /(_ kT) /submxP [c yE].
have : y *m A = 0 by rewrite yE -!mulmxA pAB Z0 mulmx0.
move/(congr1 (col h)); rewrite yA col0 => /matrixP /(_ ord0 ord0); rewrite !mxE eqxx mulr1n mulr1 => /eqP.
by rewrite subr_eq0 => /eqP.
Qed.

Theorem spanned t (T : 'M[F]_(N, t)) : p *m T = 0 -> q *m T = 0 -> (N <= \rank T + 4)%N ->
  exists2 H : 'M[F]_4, H \in unitmx & q = H *m p.
Proof.
move=> /sub_kermxP pT /sub_kermxP qT rT.
have kT : (kermx T <= p)%MS.
  rewrite -(geq_leqif (mxrank_leqif_sup pT)) (eqP pfree) mxrank_ker; have := rank_leq_row T.
  by move: (\rank T) rT => x; clear; lia.
have /submxP [H qE] := submx_trans qT kT; exists H => //.
rewrite -row_free_unit /row_free eqn_leq rank_leq_row /= -[X in (X <= _)%N](eqP qfree) qE.
exact: mxrankM_maxl.
Qed.
End Forms.

(* ------------------------------------------------------------------ planes through centres *)
(* The plane that holds the centres of A and B, and what z stands for, as lines in the two images *)
Section Planes.
Variable R : comRingType.
Implicit Types A B : 'M[R]_(3, 4).
Definition line_in A B (z : 'rV[R]_4) : 'rV[R]_3 := z *m (B^T *m fund A B).
Definition line_of A B (z : 'rV[R]_4) : 'rV[R]_3 := - (z *m (A^T *m (fund A B)^T)).
Definition centre_of A : 'rV[R]_4 := \row_k - ((-1) ^+ k * \det (col' k A)).

Lemma same_plane A B z : line_in A B z *m A = line_of A B z *m B.
Proof.
have := skew A B; cbv zeta; rewrite !trmx_mul trmxK => sk.
rewrite /line_in /line_of mulNmx -!mulmxA -mulmxN; congr (_ *m _); rewrite mulmxA sk opprK //.
Qed.

Lemma centre_ofP A : A *m (centre_of A)^T = 0.
Proof.
apply/matrixP=> i j; rewrite ord1 mxE [RHS]mxE; pose X : 'M[R]_4 := col_mx (row i A) A.
have first : ord0 = lshift 3 (@ord0 0) :> 'I_(1 + 3) by apply: val_inj.
have X0 : \det X = 0.
  apply: (@determinant_alternate _ _ X ord0 (rshift 1 i)) => // k.
  rewrite first; apply: etrans (col_mxEu (row i A) A (@ord0 0) k) _; rewrite mxE.
  exact/esym/(col_mxEd (row i A) A i k).
move: X0; rewrite (expand_det_row _ ord0) => X0; apply/eqP; rewrite -oppr_eq0 -[X in _ == X]X0 -sumrN; apply/eqP.
apply: eq_bigr => k _.
have -> : X ord0 k = A i k by rewrite first; apply: etrans (col_mxEu (row i A) A (@ord0 0) k) _; rewrite mxE.
rewrite [(centre_of A)^T _ _]mxE [centre_of A _ _]mxE /cofactor mulrN opprK add0n.
congr (_ * (_ * \det _)); apply/matrixP=> r c; rewrite !mxE.
have -> : lift ord0 r = rshift 1 r :> 'I_(1 + 3) by apply: val_inj.
by case: split_ordP => s /eqP; rewrite ?eq_rlshift ?(inj_eq (@rshift_inj _ _)) => /eqP // ->.
Qed.
End Planes.

Section Middle.
Variable F : fieldType.
Hypothesis two0 : 2%:R != 0 :> F.
Implicit Types A B V : 'M[F]_(3, 4).

Lemma in_middle A B V : row_free V -> (line_in A B (centre_of V) *m A <= V)%MS.
Proof.
move=> fV; set z := centre_of V; have Vz := centre_ofP V; rewrite -/z in Vz.
have sk := skew A B; cbv zeta in sk; set S := _ *m A in sk.
have wE : line_in A B z *m A = z *m S by rewrite /line_in /S !mulmxA.
clearbody S; rewrite wE.
have w0 : z *m S *m z^T = 0.
  have e : (z *m S *m z^T)^T = - (z *m S *m z^T) by rewrite !trmx_mul trmxK sk mulNmx mulmxN mulmxA.
  apply/eqP; move/eqP: e; rewrite [(_ *m z^T)]mx11_scalar tr_scalar_mx -addr_eq0 -raddfD /= -mulr2n -mulr_natl => /eqP.
  move/matrixP => /(_ ord0 ord0); rewrite !mxE eqxx !mulr1n => /eqP; rewrite mulf_eq0 (negbTE two0) /= => /eqP e.
  by rewrite {}e raddf0.
case: (eqVneq z 0) => [-> | z0]; first by rewrite mul0mx sub0mx.
have kz : (V <= kermx z^T)%MS by apply/sub_kermxP.
apply: submx_trans (_ : (kermx z^T <= V)%MS); first exact/sub_kermxP.
rewrite -(geq_leqif (mxrank_leqif_sup kz)) (eqP fV) mxrank_ker mxrank_tr.
have : (0 < \rank z)%N by rewrite lt0n mxrank_eq0.
by move: (\rank z) => r; clear; lia.
Qed.
End Middle.

(* ------------------------------------------------------------------ one link *)
Section Link.
Variable F : fieldType.
Hypothesis two0 : 2%:R != 0 :> F.
Implicit Types A B V Qa Qb : 'M[F]_(3, 4).
Definition tied A B Qa Qb : Prop := exists2 H : 'M[F]_4, H \in unitmx & Qa = A *m H /\ Qb = B *m H.
Definition joined A B Qa Qb : Prop := exists2 H : 'M[F]_4, H \in unitmx &
  exists x y : F, [/\ x != 0, y != 0, Qa = x *: (A *m H) & Qb = y *: (B *m H)].

Lemma tied_plane A B Qa Qb z : tied A B Qa Qb -> line_in A B z *m Qa = line_of A B z *m Qb.
Proof. by case=> H _ [-> ->]; rewrite !mulmxA same_plane. Qed.
Lemma tied_sym A B Qa Qb : tied A B Qa Qb -> tied B A Qb Qa.
Proof. by case=> H u [a b]; exists H. Qed.
Lemma joined_sym A B Qa Qb : joined A B Qa Qb -> joined B A Qb Qa.
Proof. by case=> H u [x [y [x0 y0 a b]]]; exists H => //; exists y, x. Qed.
Lemma joined_tied A B Qa Qb : joined A B Qa Qb -> exists2 s : F, s != 0 & tied A B Qa (s *: Qb).
Proof.
case=> H u [x [y [x0 y0 -> ->]]]; exists (x / y); first by rewrite mulf_neq0 ?invr_eq0.
exists (x *: H); first by rewrite unitmxZ // unitfE.
by rewrite scalerA divfK // !scalemxAr.
Qed.
Lemma joined_middle A B V Qa Qb Qv : row_free V -> joined A V Qa Qv -> joined V B Qv Qb ->
  let z := centre_of V in exists2 s : F, s != 0 & line_in A B z *m Qa = s *: (line_of A B z *m Qb).
Proof.
move=> fV [H _ [x [y [x0 y0 ea ev]]]] [H' _ [y' [x' [y'0 x'0 ev' eb]]]] z.
exists (x * y' / (y * x')); first by rewrite !mulf_neq0 // invr_eq0 mulf_neq0.
exact: (between y0 x'0 erefl (same_plane A B z) (in_middle two0 A B fV) ea ev ev' eb).
Qed.
Lemma corner A B V Qa Qb Qv : row_free A -> row_free B -> row_free V -> row_free (independence B A V) ->
  tied A B Qa Qb -> tied B V Qb Qv -> joined A V Qa Qv -> tied A V Qa Qv.
Proof.
move=> fA fB fV ind [H1 u1 [a1 b1]] [H2 u2 [b2 v2]] [H3 u3 [x [y [x0 y0 a3 v3]]]]; exists H1; rewrite // a1; split=> //.
have := three_bodies (A := B) (C := A) (V := V) (H1 := H1) (H2 := H2) (H3 := H3) (s1 := 1) (s2 := 1) (t1 := 1)
  (t3 := x) (w2 := 1) (w3 := y) fB fA fV ind u3 (oner_neq0 _) (oner_neq0 _).
rewrite !scale1r v2 => -> //; [by rewrite -b1 | by rewrite -a1 | by rewrite -v2].
Qed.
End Link.

(* ------------------------------------------------------------------ forms as matrices of polynomials *)
Section Forms.
Variables (n : nat) (V : nat -> 'I_n) (C : nat) (node_at : nat -> nat).
Hypothesis valV : forall x, (x < n)%N -> val (V x) = x.

Section Ring.
Variables (R : comRingType) (P : cameras R n).
Definition z_of (v : via) : 'rV[R]_4 :=
  match v with Direct a _ => \row_k (k == a :> nat)%:R | Middle m _ _ => centre_of (cam P (V m)) end.
Definition ends (l : link) (i : nat) : 'M[R]_(3, 4) := cam P (V (node_at i)).
Definition from_line l := line_in (ends l (from l)) (ends l (to l)) (z_of (by_ l)).
Definition to_line l := line_of (ends l (from l)) (ends l (to l)) (z_of (by_ l)).
(* a line at node s, as a column *)
Definition at_node (s : nat) (a : 'rV[R]_3) : 'cV[R]_(3 * C) := \col_c \sum_(h < 3) (c == 3 * s + h :> nat)%N%:R * a 0 h.
Definition form_col (f : form) : 'cV[R]_(3 * C) :=
  match f with
  | Whole l => at_node (from l) (from_line l) - at_node (to l) (to_line l)
  | From l => at_node (from l) (from_line l)
  | To l => - at_node (to l) (to_line l)
  end.
Definition forms_mx (L : seq form) : 'M[R]_(3 * C, size L) := \matrix_(c, t) form_col (tnth (in_tuple L) t) c 0.
End Ring.

Lemma poly_mulmx m q t (A : forall R : comRingType, cameras R n -> 'M[R]_(m, q)) (B : forall R : comRingType, cameras R n -> 'M[R]_(q, t)) :
  polynomial_matrix A -> polynomial_matrix B -> polynomial_matrix (fun R P => A R P *m B R P).
Proof.
move=> pA pB i j; apply: poly_eq (poly_sum (index_enum _) (fun k => poly_mul (pA i k) (pB k j))) => R P.
by rewrite mxE.
Qed.
Lemma poly_tr m q (A : forall R : comRingType, cameras R n -> 'M[R]_(m, q)) :
  polynomial_matrix A -> polynomial_matrix (fun R P => (A R P)^T).
Proof. by move=> pA i j; apply: poly_eq (pA j i) => R P; rewrite mxE. Qed.
Lemma poly_oppmx m q (A : forall R : comRingType, cameras R n -> 'M[R]_(m, q)) :
  polynomial_matrix A -> polynomial_matrix (fun R P => - A R P).
Proof. by move=> pA i j; apply: poly_eq (poly_opp (pA i j)) => R P; rewrite mxE. Qed.
Lemma poly_z v : polynomial_matrix (fun R (P : cameras R n) => z_of P v).
Proof.
move=> i k; case: v => [a why|m why why'] /=.
  by apply: poly_eq (poly_number n (3 * 4) ((k == a :> nat) : nat)%:Z) => R P; rewrite mxE -pmulrn.
have d : is_polynomial (fun R (P : cameras R n) => \det (col' k (cam P (V m)))).
  by apply: poly_det => r c; apply: poly_eq (poly_camera (V m) r (lift k c)) => R P; rewrite [RHS]mxE.
apply: poly_eq (poly_opp (poly_mul (poly_number n (3 * 4) ((-1) ^+ k)) d)) => R P.
by rewrite rmorphX rmorphN rmorph1 mxE.
Qed.
Lemma poly_from l : polynomial_matrix (fun R (P : cameras R n) => from_line P l).
Proof.
apply: poly_mulmx; first exact: poly_z.
by apply: poly_mulmx; [apply: poly_tr; exact: poly_cam | exact: poly_fund].
Qed.
Lemma poly_to l : polynomial_matrix (fun R (P : cameras R n) => to_line P l).
Proof.
apply: poly_oppmx; apply: poly_mulmx; first exact: poly_z.
by apply: poly_mulmx; apply: poly_tr; [exact: poly_cam | exact: poly_fund].
Qed.
Lemma poly_part s (a : forall R : comRingType, cameras R n -> 'rV[R]_3) : polynomial_matrix a ->
  polynomial_matrix (fun R P => at_node s (a R P)).
Proof.
move=> pa c i; have e (h : 'I_3) := poly_mul (poly_number n (3 * 4) ((c == 3 * s + h :> nat)%N : nat)%:Z) (pa 0 h).
apply: poly_eq (poly_sum (index_enum _) e) => R P; rewrite mxE.
by apply: eq_bigr => h _; rewrite -pmulrn.
Qed.
Lemma poly_forms L : polynomial_matrix (fun R (P : cameras R n) => forms_mx P L).
Proof.
move=> c t; have fm := poly_part (from _) (poly_from _); have tm := poly_part (to _) (poly_to _).
pose f := tnth (in_tuple L) t; have e : is_polynomial (fun R (P : cameras R n) => form_col P f c 0).
  case: f => l /=; [| exact: fm |].
    apply: poly_eq (poly_add (fm l l c 0) (poly_opp (tm l l c 0))) => R P.
    by rewrite [RHS]mxE [X in _ = _ + X]mxE.
  by apply: poly_eq (poly_opp (tm l l c 0)) => R P; rewrite [RHS]mxE.
by apply: poly_eq e => R P; rewrite [RHS]mxE.
Qed.

(* a line at a camera, against all of them *)
Definition stack (F : fieldType) (X : nat -> 'M[F]_(3, 4)) : 'M[F]_(4, 3 * C) := \matrix_(k, c) X (c %/ 3)%N (inord (c %% 3)) k.
Lemma sum_part (R : comRingType) (g : 'I_(3 * C) -> R) (s : nat) (a : 'rV[R]_3) : (s < C)%N ->
  \sum_c g c * at_node s a c 0 = \sum_(h < 3) a 0 h * (if insub (3 * s + h)%N is Some c then g c else 0).
Proof.
move=> sC; under eq_bigr => c _ do rewrite mxE big_distrr /=.
rewrite exchange_big /=; apply: eq_bigr => h _.
have lt : (3 * s + h < 3 * C)%N by case: h => [h h3] /=; lia.
rewrite insubT (bigD1 (Ordinal lt)) //= eqxx mul1r big1 ?addr0 ?[g _ * _]mulrC // => c.
by rewrite -val_eqE /= => /negbTE ->; rewrite mul0r mulr0.
Qed.
Lemma stack_part (F : fieldType) (X : nat -> 'M[F]_(3, 4)) s (a : 'rV[F]_3) : (s < C)%N -> stack X *m at_node s a = (a *m X s)^T.
Proof.
move=> sC; apply/matrixP=> k j; rewrite ord1 !mxE sum_part //; apply: eq_bigr => h _.
have h3 := ltn_ord h; have lt : (3 * s + h < 3 * C)%N by lia.
rewrite insubT !mxE /= mulnC divnMDl // modnMDl divn_small // modn_small // addn0.
by congr (_ * X _ _ _); apply: val_inj; rewrite /= inordK.
Qed.
End Forms.

(* ------------------------------------------------------------------ ranks modulo a prime *)
Section Ranks.
Variables (p : nat).
Hypothesis p_prime : prime p.
Notation Fp := 'F_p.
Definition entries_of N (u : 'rV[Fp]_N) (k : nat) : Fp := if insub k is Some c then u 0 c else 0.

Lemma pivots_rank N m (A : 'M[Fp]_(N, m)) Y : (forall u : 'rV_N, u *m A = 0 -> forall y, y \in Y -> eval y (entries_of u) = 0) ->
  (size (pivots_of p N Y) <= \rank A)%N.
Proof.
move=> hY; have := size_free p N Y; set fr := free _ _; set s := size (pivots_of _ _ _) => sz.
pose G : 'M[Fp]_(N, size fr) := \matrix_(c, f) (c == nth 0%N fr f :> nat)%:R.
have inj : row_free (row_mx A G).
  rewrite -kermx_eq0; apply/rowV0P=> u /sub_kermxP /eqP; rewrite mul_mx_row row_mx_eq0 => /andP [/eqP uA /eqP uG].
  have all0 : forall k, entries_of u k = 0.
    apply: (pivots_sound p_prime (N := N) (hY u uA)) => [k Nk|k kf]; first by rewrite /entries_of insubF // ltnNge Nk.
    have kN : (k < N)%N by move: kf; rewrite mem_filter mem_iota => /andP [].
    have li : (index k fr < size fr)%N by rewrite index_mem.
    move/rowP: uG => /(_ (Ordinal li)); rewrite !mxE (bigD1 (Ordinal kN)) //= mxE /= nth_index // eqxx mulr1.
    rewrite big1 ?addr0 => [u0|c ck]; first by rewrite /entries_of insubT -[RHS]u0; congr (u 0 _); apply: val_inj.
    by rewrite mxE nth_index //; move: ck; rewrite -val_eqE /= => /negbTE ->; rewrite mulr0.
  by apply/rowP=> c; rewrite [RHS]mxE -(all0 c) /entries_of valK.
have : (N <= \rank A + \rank G)%N.
  rewrite -[X in (X <= _)%N](eqP inj) -mxrank_tr tr_row_mx -(mxrank_tr A) -(mxrank_tr G).
  by rewrite -addsmxE mxrank_adds_leqif.
by have := rank_leq_col G; move: sz; move: (size fr) (\rank A) (\rank G) s => x y z s; clear; lia.
Qed.

Lemma map_forms n m q (A : forall R : comRingType, cameras R n -> 'M[R]_(m, q)) (R S : comRingType) (f : {rmorphism R -> S}) P :
  polynomial_matrix A -> map_mx f (A R P) = A S (map_mx f P).
Proof. by move=> pA; apply/matrixP=> i j; rewrite mxE; have [e eE] := pA i j; rewrite -!eE map_evaluate. Qed.

Lemma generic_mod_p n m q (A : forall R : comRingType, cameras R n -> 'M[R]_(m, q)) cs r : polynomial_matrix A ->
  (r <= \rank (A _ (normal n (csF p cs))))%N -> @generically n (3 * 4) (fun F P => (r <= \rank (A F P))%N).
Proof.
move=> pA h; pose cZ v k : int := (cs v k)%:Z.
have e (R : comRingType) : normal n (fun v k => (cZ v k)%:~R : R) = map_mx intr (normal n cZ).
  apply/row_matrixP=> v; rewrite -map_row !rowK.
  rewrite (map_mxvec (intmul1_rmorphism R)); congr mxvec; apply/matrixP=> i k.
  by rewrite !mxE /normal_entry; case: ifP => _; [case: (_ == _) | exact/esym/(rmorphN (intmul1_rmorphism R))].
apply: (rank_generically (P0 := normal n (fun v k => (cZ v k)%:~R)) pA); apply: leq_trans h _.
have -> : normal n (csF p cs) = map_mx intr (normal n cZ).
  by rewrite -e; apply/row_matrixP=> v; rewrite !rowK.
rewrite e -(map_forms (intmul1_rmorphism [comRingType of Fp]) _ pA) -(map_forms (intmul1_rmorphism rat_comRing) _ pA).
exact: proposition_1_4.
Qed.
End Ranks.

Lemma centre_normal (R : comRingType) (c : nat -> nat -> R) v :
  centre_of (mx 3 4 (normal_entry c v)) = \row_k (if (k < 3)%N then c v k else 1).
Proof.
apply/rowP=> k; rewrite !mxE.
have -> : col' k (mx 3 4 (normal_entry c v)) = mx 3 3 (fun r d => normal_entry c v r (bump k d)).
  by apply/matrixP=> r d; rewrite !mxE.
rewrite det3E; case: k => [[|[|[|[|//]]]] ?]; rewrite /det3 /det2 /minor /normal_entry /bump /=; ring.
Qed.

Section Rows.
Variables (n : nat) (V : nat -> 'I_n) (C : nat) (node_at : nat -> nat).
Hypothesis valV : forall x, (x < n)%N -> val (V x) = x.
Hypothesis nodes_lt : forall i, (i < C)%N -> (node_at i < n)%N.
Definition fine (l : link) : bool :=
  [&& (from l < C)%N, (to l < C)%N & match by_ l with Direct a _ => (a < 4)%N | Middle v _ _ => (v < n)%N end].
Definition link_of (f : form) := match f with Whole l | From l | To l => l end.

Variables (p : nat) (cs : nat -> nat -> nat).
Hypothesis p_prime : prime p.
Notation Fp := 'F_p.
Notation P0 := (normal n (csF p cs)).
Notation from_line := (from_line V node_at).
Notation to_line := (to_line V node_at).
Notation plane := (plane_entry node_at p cs).

Lemma ends_normal l : fine l -> forall h : 'I_3,
  from_line P0 l 0 h = (plane l h)%:R /\ to_line P0 l 0 h = (plane l h)%:R.
Proof.
case/and3P=> fC tC by_fine h; have [fn tn] := (nodes_lt fC, nodes_lt tC).
rewrite /from_line /to_line /line_in /line_of /ends !cam_normal !valV // fund_normal left_i left_j mulmxN opprK.
set M := M_entry _ _ _ _ _ _; suff -> : (z_of V P0 (by_ l) *m mx 4 3 M) 0 h = (plane l h)%:R by [].
have ME a : (M_entry 0%N (addp p) (mulp p) (oppp p) (cs (node_at (from l))) (cs (node_at (to l))) a h)%:R = M a h by exact: M_entryE.
rewrite mxE !big_ord_recl big_ord0 /plane_entry; case: (by_ l) by_fine => [a why | v why why'] vn /=.
  rewrite ME !mxE /=; case: a vn => [|[|[|[|//]]]] _ /=; rewrite ?mulr1n ?mulr0n ?mul0r ?mul1r ?addr0 ?add0r //.
rewrite cam_normal centre_normal valV // !mxE /= !addpE // !mulpE // !ME mul1r addr0.
by [].
Qed.

Lemma sum3 (R : comRingType) (g : 'I_3 -> R) : \sum_h g h = g ord0 + (g (lift ord0 ord0) + (g (lift ord0 (lift ord0 ord0)) + 0)).
Proof. by rewrite !big_ord_recl big_ord0. Qed.

Lemma eval_form f (u : 'rV[Fp]_(3 * C)) : fine (link_of f) ->
  eval (form_row node_at p cs f) (entries_of u) = (u *m form_col V C node_at P0 f) 0 0.
Proof.
have three (s : nat) (a : 'rV[Fp]_3) (e : nat -> nat) : (s < C)%N -> (forall h : 'I_3, a 0 h = (e h)%:R) ->
    (u *m at_node C s a) 0 0 = (e 0%N)%:R * entries_of u (3 * s)%N + ((e 1%N)%:R * entries_of u (3 * s + 1)%N + ((e 2%N)%:R * entries_of u (3 * s + 2)%N + 0)).
  move=> sC ae; rewrite mxE sum_part // sum3 !ae /= addn0.
  by [].
have minus s (a : 'rV[Fp]_3) : (u *m - at_node C s a) 0 0 = - (u *m at_node C s a) 0 0 by rewrite mulmxN mxE.
case: f => l /= fl; have e := ends_normal fl; have /and3P [fC tC _] := fl.
- rewrite mulmxBr mxE [X in _ = _ + X]mxE (three _ _ (plane l) fC) => [|h]; last by have [] := e h.
  rewrite (three _ _ (plane l) tC) => [|h]; last by have [] := e h.
  rewrite /eval /from_row /to_row /= !big_cons big_nil /= !opppE //.
  move: (entries_of u) ((plane l 0)%:R) ((plane l 1)%:R) ((plane l 2)%:R) => v x y z; ring.
- by rewrite (three _ _ (plane l) fC) => [|h]; [rewrite /eval /from_row !big_cons big_nil | have [] := e h].
rewrite minus (three _ _ (plane l) tC) => [|h]; last by have [] := e h.
by rewrite /eval /to_row !big_cons big_nil /= !opppE // !mulNr !opprD oppr0.
Qed.

Lemma form_rowsP L y : y \in form_rows node_at p cs L -> exists t, y = form_row node_at p cs (tnth (in_tuple L) t).
Proof.
move=> yL; suff : exists2 f, f \in map id (iota 0 (size L)) & exists d, y = form_row node_at p cs (nth d L f).
  case=> k + [d ->]; rewrite map_id mem_iota => kL; exists (Ordinal kL).
  by rewrite (tnth_nth d).
elim: L yL => //= f L ih; rewrite inE => /predU1P [-> | /ih [k kL [d e]]]; first by exists 0%N; rewrite ?inE //; exists f.
exists k.+1; last by exists d.
by move: kL; rewrite !map_id !inE !mem_iota add1n.
Qed.

Theorem shown_generic L r : (forall t, fine (link_of (tnth (in_tuple L) t))) -> (r <= size (pivots_of p (3 * C) (form_rows node_at p cs L)) + 4)%N ->
  @generically n (3 * 4) (fun F P => (r <= \rank (forms_mx V C node_at P L) + 4)%N).
Proof.
move=> fL le.
have h : (size (pivots_of p (3 * C) (form_rows node_at p cs L)) <= \rank (forms_mx V C node_at P0 L))%N.
  apply: pivots_rank => // u uL y /form_rowsP [t ->]; rewrite eval_form //.
  move/rowP: uL => /(_ t); rewrite [RHS]mxE => <-; rewrite mxE [RHS]mxE; apply: eq_bigr => c _.
  by rewrite [forms_mx _ _ _ _ _ _ _]mxE.
have pf : polynomial_matrix (fun R (P : cameras R n) => forms_mx V C node_at P L) by exact: poly_forms.
have g := generic_mod_p pf h.
apply: (generically_impl _ g) => F P le'.
by apply: leq_trans le _; rewrite leq_add2r.
Qed.
End Rows.

(* ------------------------------------------------------------------ scales that are settled one by one *)
Fixpoint every (T : Type) (A : T -> Prop) (s : seq T) : Prop := if s is x :: s' then A x /\ every A s' else True.
Lemma every_nth T (A : T -> Prop) d s : every A s <-> forall i, (i < size s)%N -> A (nth d s i).
Proof.
elim: s => //= x s [ih1 ih2]; split=> [[ax /ih1 h] [|i] // /h //|h].
by split; [exact: (h 0%N) | apply: ih2 => i; exact: (h i.+1)].
Qed.
Lemma every_impl T (A B : T -> Prop) s : (forall x, A x -> B x) -> every A s -> every B s.
Proof. by move=> h; elim: s => //= x s ih [/h ? /ih]. Qed.

Section Sound.
Variables (n : nat) (V : nat -> 'I_n) (C : nat) (node_at : nat -> nat) (allowed : nat -> nat -> reason -> bool).
Variables (F : numFieldType) (P Q : cameras F n).
Hypotheses (niceP : no_three_on_a_line P) (C1 : (1 < C)%N).
Notation N i := (V (node_at i)).
Hypothesis N_inj : forall i j, (i < C)%N -> (j < C)%N -> i != j -> N i != N j.
Hypothesis allowedP : forall x y why, allowed x y why -> same_cameras P Q [:: V x; V y].
Notation p i := (cam P (N i)).
Notation forms_mx := (forms_mx V C node_at P).
Notation form_col := (form_col V C node_at P).
Notation from_line := (from_line V node_at P).
Notation to_line := (to_line V node_at P).
Notation at_node := (at_node C).
Notation stack := (stack C).
Notation link_ok := (link_ok n allowed C node_at).

Lemma two_neq0 : 2%:R != 0 :> F. Proof. by rewrite pnatr_eq0. Qed.
Lemma rows_free v : row_free (cam P v). Proof. by case: niceP. Qed.

Lemma allowed_joined x y why (a b : F) : a != 0 -> b != 0 -> allowed x y why ->
  joined (cam P (V x)) (cam P (V y)) (a *: cam Q (V x)) (b *: cam Q (V y)).
Proof.
move=> a0 b0 /allowedP [H u h]; have [s s0 ->] := h _ (mem_head _ _); have [t t0 ->] := h (V y) (mem_last (V x) [:: V y]).
by exists H => //; exists (a * s), (b * t); rewrite !scalerA !mulf_neq0.
Qed.

(* what a link with scale 1 says *)
Definition rel (l : link) (Qa Qb : 'M[F]_(3, 4)) : Prop :=
  match by_ l with
  | Direct _ _ => tied (p (from l)) (p (to l)) Qa Qb
  | Middle _ _ _ => from_line l *m Qa = to_line l *m Qb
  end.
Lemma rel_line l Qa Qb : rel l Qa Qb -> from_line l *m Qa = to_line l *m Qb.
Proof. by rewrite /rel; case: (by_ l) => // a why /tied_plane ->. Qed.
Lemma p_line l : from_line l *m p (from l) = to_line l *m p (to l). Proof. exact: same_plane. Qed.
Lemma link_okP l (a b : F) : link_ok l -> a != 0 -> b != 0 ->
  exists2 s : F, s != 0 & rel l (a *: cam Q (N (from l))) (s *: (b *: cam Q (N (to l)))).
Proof.
rewrite /link_ok /rel; case: ifP => // _; case: ifP => // _; case e: (by_ l) => [d why | v why why'].
  case: ifP => // _ al a0 b0; exact: joined_tied (allowed_joined a0 b0 al).
case: ifP => // _; case: ifP => // al1 al2 a0 b0.
have [s s0 h] := joined_middle two_neq0 (rows_free (V v)) (allowed_joined a0 (oner_neq0 _) al1) (allowed_joined (oner_neq0 _) b0 al2).
by exists s => //; rewrite /from_line /to_line /ends e; apply: etrans h _; rewrite scalemxAr.
Qed.
Lemma link_ends l : link_ok l -> (from l < C)%N /\ (to l < C)%N.
Proof. by rewrite /link_ok; case: ifP => // fC; case: ifP => // tC _. Qed.

(* Factors of the nodes of a tree, such that all its links have scale 1 *)
Lemma treeP tree K : tree_ok n allowed C node_at tree K -> exists t : nat -> F, (forall i, t i != 0) /\
  forall k, (0 < k < K)%N -> [/\ link_ok (tree k), to (tree k) = k, (from (tree k) < k)%N &
    rel (tree k) (t (from (tree k)) *: cam Q (N (from (tree k)))) (t k *: cam Q (N k))].
Proof.
elim: K => [|K ih]; first by exists (fun _ => 1); split=> [i|[]//]; exact: oner_neq0.
rewrite [tree_ok _ _ _ _ _ _]/=; case: K ih => [|K] ih; first by exists (fun _ => 1); split=> [i|[|k] //]; exact: oner_neq0.
case: eqnP => // toK; case: ifP => // fK; case: ifP => // ok /ih [t [t0 h]].
have [s s0 r] := link_okP ok (t0 (from (tree K.+1))) (oner_neq0 _); rewrite scale1r toK in r.
exists (fun i => if i == K.+1 then s else t i); split=> [i|k /andP [k0]]; first by case: ifP.
rewrite ltnS leq_eqVlt => /predU1P [-> | kK]; first by rewrite eqxx (ltn_eqF fK).
have [ok' e f r'] := h k (introT andP (conj k0 kK)).
by rewrite (ltn_eqF kK) (ltn_eqF (ltn_trans f kK)).
Qed.

Variable t : nat -> F.
Hypothesis t0 : forall i, t i != 0.
Notation q i := (t i *: cam Q (N i)).
Notation known := (fun l => [/\ link_ok l, rel l (q (from l)) (q (to l)) & True]).
Definition holds (d : demand) : Prop := (d.2 <= \rank (forms_mx d.1) + 4)%N.

Lemma learnP l K : known l -> every known K -> every known (learn l K).
Proof.
rewrite /learn => -[ok r _] kK; case e: (by_ l) => [a why|v why why'] /=; last by split=> //.
have ok' b : (b < 4)%N -> link_ok (Link (from l) (to l) (Direct b why)).
  by move=> b4; move: ok; rewrite /link_ok /= e b4; do 2!case: ifP => // _; case: ifP.
have r' b : rel (Link (from l) (to l) (Direct b why)) (q (from l)) (q (to l)) by move: r; rewrite /rel e.
by do !split=> //; apply: ok'.
Qed.

Lemma stack_free (X : nat -> 'M[F]_(3, 4)) : (forall z : 'rV_4, X 0%N *m z^T = 0 -> X 1%N *m z^T = 0 -> z = 0) -> row_free (stack X).
Proof.
move=> h; rewrite -kermx_eq0; apply/rowV0P=> z /sub_kermxP z0; apply: h; apply/row_matrixP=> i; rewrite row0 row_mul rowE;
  apply: trmx_inj; rewrite trmx_mul trmxK trmx0 -(@stack_part C) ?mulmxA ?z0 ?mul0mx //; exact: ltnW.
Qed.
Lemma no_centre i j (z : 'rV_4) : (i < C)%N -> (j < C)%N -> i != j -> p i *m z^T = 0 -> p j *m z^T = 0 -> z = 0.
Proof.
move=> iC jC ij pi pj; have [_ /(_ _ _ (N_inj iC jC ij)) fn _] := niceP.
have nz : fund (p i) (p j) != 0 by rewrite -mxrank_eq0 -lt0n ltnW.
have full := distinct nz; apply/eqP; apply: contraT => z0.
have : (p i + p j <= kermx z^T)%MS by rewrite addsmx_sub; apply/andP; split; apply/sub_kermxP.
move/mxrankS; rewrite full mxrank_ker mxrank_tr; have : (0 < \rank z)%N by rewrite lt0n mxrank_eq0.
by move: (\rank z) => r; clear; lia.
Qed.
Lemma p_free : row_free (stack (fun i => p i)).
Proof. by apply: stack_free => z; apply: no_centre => //; exact: ltnW. Qed.
Lemma q_free : tied (p 0) (p 1) (q 0) (q 1) -> row_free (stack (fun i => q i)).
Proof.
case=> H u [e0 e1]; apply: stack_free => z; rewrite e0 e1 -!mulmxA => a b.
have := @no_centre 0 1 (z *m H^T); rewrite trmx_mul trmxK => /(_ (ltnW C1) C1 isT a b) /eqP.
by rewrite mulmx_free_eq0 ?row_free_unit ?unitmx_tr // => /eqP.
Qed.

Lemma forms_every (y : 'rV_(3 * C)) L : every (fun f => y *m form_col f = 0) L -> y *m forms_mx L = 0.
Proof.
move=> h; apply/rowP=> k; have e : y *m form_col (tnth (in_tuple L) k) = 0.
  case: L h k => [|f L] h k; first by case: k.
  by rewrite (tnth_nth f); apply: (proj1 (every_nth _ f (f :: L)) h).
move/rowP: e => /(_ 0); rewrite mxE [RHS]mxE => e; rewrite [RHS]mxE -[RHS]e mxE; apply: eq_bigr => c _.
by rewrite [forms_mx _ _ _]mxE.
Qed.
Lemma whole_p l : known l -> stack (fun i => p i) *m form_col (Whole l) = 0.
Proof. by case=> /link_ends [fC tC] _ _; rewrite /= mulmxBr !stack_part // p_line subrr. Qed.
Lemma whole_q l : known l -> stack (fun i => q i) *m form_col (Whole l) = 0.
Proof. by case=> /link_ends [fC tC] /rel_line r _; rewrite /= mulmxBr !stack_part // r subrr. Qed.
Lemma wholesP (A : form -> Prop) K : every (fun l => A (Whole l)) K -> every A (wholes K).
Proof. by elim: K => //= l K ih [? /ih]. Qed.
Lemma sidesP (A : form -> Prop) L tail : every (fun l => A (From l) /\ A (To l)) L -> every A tail -> every A (sides L tail).
Proof. by move=> + tl; elim: L => //= l L ih [[? ?] /ih]. Qed.
Lemma countE L : count L = size L. Proof. by elim: L => //= l L ->. Qed.
Lemma links_okP L : links_ok n allowed C node_at L -> every (fun l => link_ok l) L.
Proof. by elim: L => //= l L ih; case: ifP => // ok /ih. Qed.

(* Theorem 10.6: the first one of some links has scale 1 *)
Lemma settle_sound l L K : row_free (stack (fun i => q i)) -> every (fun l => link_ok l) (l :: L) -> every known K ->
  holds (To l :: sides L (wholes K), (3 * C + count (l :: L))%N) -> known l.
Proof.
move=> qf ok kK; rewrite /holds /= -/(count (l :: L)) countE => rk; set M := l :: L in ok rk.
pose g (k : 'I_(size M)) := nth l M k; have gok k : link_ok (g k) by apply: (proj1 (every_nth _ l M) ok).
have ex k : exists s : F, rel (g k) (q (from (g k))) (s *: q (to (g k))).
  by have [s _ h] := link_okP (gok k) (t0 (from (g k))) (t0 (to (g k))); exists s.
have [s hs] := fin_all_exists ex.
pose A : 'M[F]_(3 * C, size M) := \matrix_(c, k) at_node (from (g k)) (from_line (g k)) c 0.
pose B : 'M[F]_(3 * C, size M) := \matrix_(c, k) at_node (to (g k)) (to_line (g k)) c 0.
have colA m (X : 'M_(m, _)) k : col k (X *m A) = X *m at_node (from (g k)) (from_line (g k)).
  by rewrite col_mul; congr (_ *m _); apply/colP=> c; rewrite mxE [LHS]mxE.
have colB m (X : 'M_(m, _)) k : col k (X *m B) = X *m at_node (to (g k)) (to_line (g k)).
  by rewrite col_mul; congr (_ *m _); apply/colP=> c; rewrite mxE [LHS]mxE.
have s1 : s ord0 = 1.
  apply: (settled (p := stack (fun i => p i)) p_free qf (A := A) (B := B) (T := forms_mx (To l :: sides L (wholes K)))) rk.
  - apply/matrixP=> i k; have [fC tC] := link_ends (gok k).
    have : col k (stack (fun i => p i) *m A) = col k (stack (fun i => p i) *m B) by rewrite colA colB !stack_part // p_line.
    by move/colP/(_ i); rewrite [LHS]mxE [RHS]mxE.
  - move=> k; have [fC tC] := link_ends (gok k); rewrite colA colB !stack_part //.
    by rewrite (rel_line (hs k)) -scalemxAr linearZ.
  move=> x x' yB yA; set y := x *m _ + _ in yB yA *; apply: forms_every.
  have yto k : y *m form_col (To (g k)) = 0 by rewrite /= mulmxN -colB yB col0 oppr0.
  split; first exact: (yto ord0).
  apply: sidesP.
    apply/(every_nth _ l) => k kL; have lt : (k.+1 < size M)%N by [].
    split; last exact: (yto (Ordinal lt)).
    by have := yA (Ordinal lt) isT; rewrite colA.
  apply: wholesP; apply: every_impl kK => l' kl'; rewrite mulmxDl -!mulmxA (whole_q kl') (whole_p kl') !mulmx0 addr0.
  by [].
by split=> //; [exact: (gok ord0) | have := hs ord0; rewrite s1 scale1r].
Qed.

Lemma tie_inP i j K : every known K -> tie_in i j K -> tied (p i) (p j) (q i) (q j).
Proof.
elim: K => //= l K ih [[_ r _] /ih {}ih]; case: ifP => // + _; rewrite /is_tie; move: r; rewrite /rel.
case: (by_ l) => // a why r; case: eqnP => [<- /eqnP <- // | _]; case: eqnP => // <- /eqnP <-; exact: tied_sym.
Qed.

Lemma demandsP steps K D : tied (p 0) (p 1) (q 0) (q 1) -> demands n allowed C node_at K steps = Some D -> every known K -> every holds D ->
  exists2 H : 'M[F]_4, H \in unitmx & forall i, (i < C)%N -> q i = p i *m H.
Proof.
move=> base; have qf := q_free base; elim: steps K D => [|st steps ih] K D /=.
  move=> [<-] kK /= [hD _].
  have [||H u e] := spanned p_free qf _ _ hD.
  - by apply/row_matrixP=> i; rewrite row0 row_mul; apply: forms_every; apply: wholesP; apply: every_impl kK => l /whole_p h; rewrite -row_mul h row0.
  - by apply/row_matrixP=> i; rewrite row0 row_mul; apply: forms_every; apply: wholesP; apply: every_impl kK => l /whole_q h; rewrite -row_mul h row0.
  exists H^T; first by rewrite unitmx_tr.
  move=> i iC; apply/row_matrixP=> h; rewrite !rowE; apply: trmx_inj.
  by rewrite -(@stack_part C _ (fun i => q i)) // e -mulmxA stack_part // mulmxA [RHS]trmx_mul trmxK.
case: st => [l L | i j k why].
  case: ifP => // /(@links_okP (l :: L)) ok; case E: (demands _ _ _ _ _ _) => [D'|//] [<-] kK /= [hd hD'].
  exact: ih E (learnP (settle_sound qf ok kK hd) kK) hD'.
case: ifP => // ij; case: ifP => // jk; case: ifP => // ok; case: eqnP => // nij; case: eqnP => // nik; case: eqnP => // njk.
move=> E kK hD; apply: ih E _ hD; apply: learnP => //; split=> //; rewrite /rel /=.
have [iC kC] := link_ends ok; have tij := tie_inP kK ij; have tjk := tie_inP kK jk.
have jC : (j < C)%N.
  elim: K kK ij {tij tjk jk} => //= l K ihK [[/link_ends [fC tC] _ _] /ihK {}ihK]; case: ifP => // + _; rewrite /is_tie.
  by case: (by_ l) => // _ _; case: eqnP => [_ /eqnP <- // | _]; case: eqnP => // <-.
have al : allowed (node_at i) (node_at k) why by move: ok; rewrite /link_ok /= iC kC.
have [_ _ lines] := niceP.
apply: corner (rows_free _) (rows_free _) (rows_free _) _ tij tjk (allowed_joined (t0 i) (t0 k) al).
by apply: lines; apply: N_inj => //; rewrite ?[j == i]eq_sym; apply/eqP.
Qed.

Lemma hangingP tree K : (forall k, (0 < k < K)%N -> known (tree k)) -> every known (hanging tree K).
Proof.
elim: K => // K ih h; rewrite /hanging -/hanging; case: K ih h => // K ih h.
apply: learnP; first by apply: h; rewrite ltnSn.
by apply: ih => k /andP [k0 kK]; apply: h; rewrite k0 ltnW.
Qed.
End Sound.

(* ------------------------------------------------------------------ what the program has seen *)
Section Seen.
Variables (n : nat) (V : nat -> 'I_n) (C : nat) (node_at : nat -> nat) (allowed : nat -> nat -> reason -> bool).
Hypothesis valV : forall x, (x < n)%N -> val (V x) = x.
Hypothesis nodes_lt : forall i, (i < C)%N -> (node_at i < n)%N.
Variables (p : nat) (cs : nat -> nat -> nat).
Hypothesis p_prime : prime p.
Notation link_ok := (link_ok n allowed C node_at).
Notation good := (fun f => fine n C (link_of f)).

Lemma link_ok_fine l : link_ok l -> fine n C l.
Proof.
rewrite /link_ok /fine; case: ifP => // fC; case: ifP => // tC; case: (by_ l) => [a why|v why why'].
  by case: ifP.
by case: ifP.
Qed.
Lemma every_learn (A : link -> Prop) l K : (forall a why, by_ l = Direct a why -> forall b, (b < 4)%N -> A (Link (from l) (to l) (Direct b why))) ->
  A l -> every A K -> every A (learn l K).
Proof. by move=> h al aK; rewrite /learn; case e: (by_ l) => [a why|v why why'] //=; do !split=> //; apply: h e _ _. Qed.
Lemma fine_learn l K : fine n C l -> every (fine n C) K -> every (fine n C) (learn l K).
Proof.
move=> fl; apply: every_learn (fl) => a why e b b4; move: fl; rewrite /fine e /= b4 => /and3P [-> -> _] //.
Qed.
Lemma fine_wholes K : every (fine n C) K -> every good (wholes K). Proof. exact: wholesP. Qed.

Lemma demands_fine steps K D : every (fine n C) K -> demands n allowed C node_at K steps = Some D ->
  every (fun d : demand => every good d.1) D.
Proof.
elim: steps K D => [|st steps ih] K D fK /=; first by move=> [<-] /=; split=> //; exact: fine_wholes.
case: st => [l L | i j k why].
  case: ifP => // /(@links_okP n C node_at allowed (l :: L)) [ol oL]; case E: (demands _ _ _ _ _ _) => [D'|//] [<-] /=.
  split; last by apply: ih E; apply: fine_learn => //; exact: link_ok_fine.
  split; first exact: link_ok_fine.
  by apply: sidesP; [apply: every_impl oL => l' /link_ok_fine | exact: fine_wholes].
do 2!case: ifP => // _; case: ifP => // ok; do 3!case: eqnP => // _.
by move/ih; apply; apply: fine_learn => //; exact: link_ok_fine.
Qed.

Lemma hanging_fine tree K : tree_ok n allowed C node_at tree K -> every (fine n C) (hanging tree K).
Proof.
elim: K => // K ih; rewrite /tree_ok -/tree_ok /hanging -/hanging; case: K ih => // K ih.
case: eqnP => // _; case: ifP => // _; case: ifP => // lok /ih h.
by apply: fine_learn => //; exact: link_ok_fine.
Qed.

Theorem demands_generic D : every (fun d : demand => every good d.1) D -> all_shown C node_at p cs D ->
  @generically n (3 * 4) (fun F P => every (holds V C node_at P) D).
Proof.
elim: D => [|[L r] D ih] /=; first by move=> _ _; exact: generically_true.
move=> [gL gD]; case: ifP => // le /(ih gD) rest.
have first : @generically n (3 * 4) (fun F P => (r <= \rank (forms_mx V C node_at P L) + 4)%N).
  apply: (shown_generic valV nodes_lt p_prime _ le) => t.
  by case: L gL t {le} => [|f L] gL t; [case: t | rewrite (tnth_nth f); apply: (proj1 (every_nth _ f (f :: L)) gL)].
exact: generically_and first rest.
Qed.
End Seen.
