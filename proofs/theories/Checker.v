(* The program, and what its answer means. Arrays come in as functions, so that nothing is supposed about arrays. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From Viewcert Require Import Statement Motions Generic Counting Rigid Models Elimination Flows Hub Cores.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

(* ------------------------------------------------------------------ the program *)

(* Keys are different if some order of them is increasing. *)
Fixpoint increasing (s : nat) (at_ : nat -> nat) (key : nat -> nat) (k : nat) : bool :=
  if k is k'.+1 then
    if at_ k' < s then
      if k' is k''.+1 then if key (at_ k'') < key (at_ k') then increasing s at_ key k' else false
      else true
    else false
  else true.

(* Why a pair of nodes may be used: it is a pair of the graph, by its number; or both nodes are in an earlier body,
   at these positions; or both are in two blocks, in a cell of each, at these positions. *)
Inductive reason := Pair of nat | Inside of nat & nat & nat | Both of nat & nat & nat & nat & nat & nat & nat & nat.

(* A body: its nodes one after the other, a core of the first ones with its rows (two positions, rows used, reason)
   and centres, and flows, if it has its rank by these; each later node is joined to at most two nodes before it. *)
Record body := Body {
  body_size : nat; node : nat -> nat; by_node : nat -> nat;
  core_size : nat; core : seq (nat * nat * nat * reason); centre : nat -> nat -> nat;
  flows : seq flow; joins : nat -> seq (nat * reason) }.

(* A block: its nodes, all of them its one cell; or the first one of them is a hub, and cells are those of a split graph. *)
Record block := Block { block_size : nat; block_node : nat -> nat; hub : option split }.

Section Program.
Variables (M : model) (n m : nat) (first second : nat -> nat).

Fixpoint pairs_ok (k : nat) : bool :=
  if k is k'.+1 then
    if first k' < second k' then if second k' < n then pairs_ok k' else false else false
  else true.
Definition graph_ok (by_pair : nat -> nat) : bool :=
  if 1 < n then
    if pairs_ok m then increasing m by_pair (fun k => n * first k + second k) m else false
  else false.

(* The rank that a body shows, where pairs may be used as [allowed] says. *)
Section Machine.
Variables (allowed : nat -> nat -> reason -> bool) (B : body).

Fixpoint core_ok (L : seq (nat * nat * nat * reason)) : bool :=
  if L is (i, j, _, why) :: L' then
    if i < core_size B then
      if j < core_size B then
        if allowed (node B i) (node B j) why then core_ok L' else false
      else false
    else false
  else true.

Fixpoint nodes_ok (k : nat) : bool :=
  if k is k'.+1 then if node B k' < n then nodes_ok k' else false else true.

(* what the nodes behind the core add *)
Fixpoint joined (d acc : nat) : option nat :=
  if d is d'.+1 then
    let s := core_size B + d' in
    match joins B s with
    | [::] => joined d' acc
    | [:: (t, why)] =>
      if t < s then
        if allowed (node B s) (node B t) why then joined d' (one M + acc) else None
      else None
    | [:: (t, why); (t', why')] =>
      if t < s then
        if t' < s then
          if eqn t t' then None
          else if allowed (node B s) (node B t) why then
            if allowed (node B s) (node B t') why' then joined d' (two M + acc) else None
          else None
        else None
      else None
    | _ => None
    end
  else Some acc.

Fixpoint core_rows (L : seq (nat * nat * nat * reason)) : seq (nat * nat * nat) :=
  if L is (e, _) :: L' then e :: core_rows L' else [::].

Definition body_rank : option nat :=
  if core_size B <= body_size B then
    if nodes_ok (body_size B) then
      if increasing (body_size B) (by_node B) (node B) (body_size B) then
        if core_ok (core B) then
          joined (body_size B - core_size B)
            (core_rank_in M (centre B) (core_size B) (core_rows (core B)) (flows B))
        else None
      else None
    else None
  else None.
End Machine.

Section Lower.
Variable bodies : nat -> body.

Definition pair_ok (mate : nat -> bool) b x y (why : reason) : bool :=
  match why with
  | Pair k => if k < m then
      if eqn (first k) x then eqn (second k) y else if eqn (first k) y then eqn (second k) x else false
    else false
  | Inside c s t => if c < b then
      if mate c then
        if s < body_size (bodies c) then
          if t < body_size (bodies c) then
            if eqn (node (bodies c) s) x then eqn (node (bodies c) t) y else false
          else false
        else false
      else false
    else false
  | Both _ _ _ _ _ _ _ _ => false
  end.

(* A body has an owner, a later body or itself, and uses only bodies that have the same one. *)
Variable owner : nat -> nat.
Definition rigid b : bool :=
  if 1 < body_size (bodies b) then
    if body_rank (pair_ok (fun c => eqn (owner c) (owner b)) b) (bodies b) is Some r then required M (body_size (bodies b)) <= r else false
  else false.
Fixpoint all_rigid b : bool := if b is b'.+1 then if rigid b' then all_rigid b' else false else true.

(* bodies 0 .. b-1 are rigid, and body b, which may use all of them, has the rank r *)
Definition lower_ok b r : bool :=
  if all_rigid b then if body_rank (pair_ok (fun _ => true) b) (bodies b) is Some s then r <= s else false else false.
End Lower.

(* Upper bounds for the pairs in some sets of nodes, by two lists of blocks, of which the second one begins at [half]. A
   set lies in a cell of a block, at these positions, or is a block of its own. What the blocks of the two lists share
   has the rank at least that a body shows. *)
Section Upper.
Variables (sets : nat) (set_size : nat -> nat) (member : nat -> nat -> nat).
Variables (blocks : nat -> block) (half : nat) (shared : body) (place : nat -> option (nat * nat * (nat -> nat))).

Fixpoint block_ok (B : block) (k : nat) : bool :=
  if k is k'.+1 then if block_node B k' < n then block_ok B k' else false else true.
Definition block_bound (B : block) : option nat :=
  if block_ok B (block_size B) then
    if hub B is Some H then if M is Projective then split_bound (block_size B) H else None
    else if 1 < block_size B then Some (required M (block_size B)) else None
  else None.
Fixpoint blocks_sum (b acc : nat) : option nat :=
  if b is b'.+1 then
    if block_bound (blocks b') is Some u then blocks_sum b' (u + acc) else None
  else Some acc.

Definition cells_of (B : block) : nat := if hub B is Some H then cell_count H else 1.
Definition size_in (B : block) (d : nat) : nat := if hub B is Some H then cell_size H d else block_size B.
Definition node_in (B : block) (d i : nat) : nat :=
  if hub B is Some H then block_node B (origin (block_size B) (cell_node H d i)) else block_node B i.
(* node i of cell d is x *)
Definition held (B : block) (d i x : nat) : bool := if i < size_in B d then eqn (node_in B d i) x else false.

Fixpoint in_cell (B : block) (d : nat) (at_ : nat -> nat) (k s : nat) : bool :=
  if s is s'.+1 then if held B d (at_ s') (member k s') then in_cell B d at_ k s' else false else true.
Fixpoint placed (b k acc : nat) : option nat :=
  if k is k'.+1 then
    match place k' with
    | None => if 1 < set_size k' then placed b k' (required M (set_size k') + acc) else None
    | Some (c, d, at_) =>
      if c < b then
        if d < cells_of (blocks c) then
          if in_cell (blocks c) d at_ k' (set_size k') then placed b k' acc else None
        else None
      else None
    end
  else Some acc.

Definition two_in (c d i j x y : nat) : bool :=
  if d < cells_of (blocks c) then if held (blocks c) d i x then held (blocks c) d j y else false else false.
Definition both_ok b x y (why : reason) : bool :=
  if why is Both c d i j c' d' i' j' then
    if c < half then
      if half <= c' then
        if c' < b then if two_in c d i j x y then two_in c' d' i' j' x y else false else false
      else false
    else false
  else false.

Definition upper_ok b r : bool :=
  if blocks_sum b 0 is Some acc then
    if placed b sets acc is Some s then
      if half < b then
        if body_rank (both_ok b) shared is Some l then s <= r + l else false
      else s <= r
    else false
  else false.
End Upper.
End Program.

(* The whole check: a lower bound of 0 and the largest upper one need no proof. *)
Definition lower_part M n m first second bodies owner b r : bool :=
  if eqn r 0 then true else lower_ok M n m first second bodies owner b r.
Definition end_of (first second : nat -> nat) k s : nat := if eqn s 0 then first k else second k.
Definition upper_part M n m first second blocks half shared c place r : bool :=
  if required M n <= r then true
  else upper_ok M n m (fun _ => 2) (end_of first second) blocks half shared place c r.
Definition verify M n m first second by_pair bodies owner b lower blocks half shared c place upper : bool :=
  if graph_ok n m first second by_pair then
    if lower_part M n m first second bodies owner b lower then upper_part M n m first second blocks half shared c place upper
    else false
  else false.

(* ------------------------------------------------------------------ its soundness *)

Lemma increasingP s at_ key : increasing s at_ key s -> uniq (mkseq key s).
Proof.
have sub k : increasing s at_ key k -> forall i, i < k -> at_ i < s.
  elim: k => [|k ih] //= h i; case: ifP h => // ks h; rewrite ltnS leq_eqVlt => /predU1P [-> // | ik].
  by case: k ih ks h ik => // k ih _; case: ifP => // _ /ih; apply.
have step k i : increasing s at_ key k -> i.+1 < k -> key (at_ i) < key (at_ i.+1).
  elim: k => [|k ih] //= h; case: ifP h => // _; rewrite ltnS leq_eqVlt => h /predU1P [ik | ik].
    by move: h; rewrite -ik; case: ifP.
  by apply: ih => //; case: k h ik => // k; case: ifP.
move=> h; have lt i j : i < j -> j < s -> key (at_ i) < key (at_ j).
  elim: j => // j ih; rewrite ltnS leq_eqVlt => /predU1P [-> | /ih lt] js; first exact: step h js.
  exact: ltn_trans (lt (ltnW js)) (step _ _ h js).
have u : uniq (mkseq (key \o at_) s).
  apply/mkseq_uniqP => i j; rewrite !inE => si sj /= e; apply/eqP; move: e.
  by case: (ltngtP i j) => // ij; [have := lt _ _ ij sj | have := lt _ _ ij si] => /[swap] ->; rewrite ltnn.
apply: (leq_size_uniq u); last by rewrite !size_mkseq.
by move=> _ /mapP [i + ->]; rewrite mem_iota => /(sub s h i) ai; apply: map_f; rewrite mem_iota.
Qed.

Section Graph.
Variables (n m : nat) (first second : nat -> nat).
Local Notation G := (pairs m first second).

Lemma pairs_okP k : pairs_ok n first second k -> forall i, i < k -> first i < second i < n.
Proof.
elim: k => [|k ih] //= h i; case: ifP h => // fs; case: ifP => // sn /ih {}ih.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /ih //]; rewrite fs.
Qed.

Theorem graph_ok_sound by_pair : graph_ok n m first second by_pair -> well_formed n G.
Proof.
rewrite /graph_ok /well_formed; case: ifP => // n1; case: ifP => // /pairs_okP lt /increasingP u.
 apply/and3P; split=> //.
- by apply/allP=> _ /mapP [k + ->]; rewrite mem_iota => /lt.
- by apply: (@map_uniq _ _ (fun e => n * e.1 + e.2)); rewrite -map_comp.
Qed.
End Graph.

Section Sound.
Variables (M : model) (n m : nat) (first second : nat -> nat) (bodies : nat -> body).
Local Notation G := (pairs m first second).
Hypothesis good : well_formed n G.
Lemma n_positive : 0 < n. Proof. by case/and3P: good => n1 _ _; apply: ltnW. Qed.
Definition V (x : nat) : 'I_n := insubd (Ordinal n_positive) x.
Lemma valV x : x < n -> val (V x) = x. Proof. by move=> xn; rewrite /V insubdK. Qed.

Definition nodes b : seq 'I_n := mkseq (fun i => V (node (bodies b) i)) (body_size (bodies b)).
Definition all_pairs (b : seq 'I_n) : seq ('I_n * 'I_n) := [seq (x, y) | x <- b, y <- b].
(* what may be used for body b *)
Fixpoint usable b : seq ('I_n * 'I_n) := if b is b'.+1 then all_pairs (nodes b') ++ usable b' else edges n G.

Lemma usable_edge b e : e \in edges n G -> e \in usable b.
Proof. by move=> eG; elim: b => //= b ih; rewrite mem_cat ih orbT. Qed.
Lemma usable_body b c e : c < b -> inside (nodes c) e -> e \in usable b.
Proof.
case: e => x y + /andP [xb yb]; elim: b => //= b ih; rewrite ltnS leq_eqVlt mem_cat.
by case/predU1P=> [<- | /ih ->]; rewrite ?orbT // allpairs_f.
Qed.

Lemma either_swap E (e : 'I_n * 'I_n) : either E (swap e) -> either E e.
Proof. by case: e => x y; rewrite /either /swap /= orbC. Qed.

Lemma edge_of k : k < m -> (V (first k), V (second k)) \in edges n G.
Proof.
move=> km; have kG : (first k, second k) \in G by apply: map_f; rewrite mem_iota.
have /and3P [_ /allP /(_ _ kG) /andP [/= fs sn] _] := good.
by apply: edges_mem; rewrite !valV // (ltn_trans fs).
Qed.

Lemma pair_okP mate b x y why : pair_ok m first second bodies mate b x y why -> either (usable b) (V x, V y).
Proof.
case: why => [k | c s t | //] /=.
  case: ifP => // /edge_of /(usable_edge b) kE; case: eqnP => [<- /eqnP <- | _]; first by rewrite /either kE.
  by case: eqnP => // <- /eqnP <-; rewrite /either /swap /= kE orbT.
case: ifP => // cb; case: ifP => // _; case: ifP => // sc; case: ifP => // tc; case: eqnP => // <- /eqnP <-.
apply/orP; left; apply: usable_body cb _.
by rewrite /inside /nodes; apply/andP; split; apply: map_f; rewrite mem_iota.
Qed.

(* What a body shows: some pairs that may be used have this rank. *)
Section Machine.
Variables (allowed : nat -> nat -> reason -> bool) (B : body) (U : seq ('I_n * 'I_n)).
Hypothesis allowedP : forall x y why, allowed x y why -> either U (V x, V y).
Let N i := V (node B i).

Section Body.
Hypothesis uniqB : uniq (mkseq (node B) (body_size B)).
Hypothesis ltB : forall i, i < body_size B -> node B i < n.

Lemma N_inj i j : i < body_size B -> j < body_size B -> N i = N j -> i = j.
Proof.
move=> ib jb /(congr1 val); rewrite !valV ?ltB // => e.
by apply: (mkseq_uniqP _ _ uniqB).
Qed.

Lemma inside_S k e : inside (mkseq N k) e -> inside (mkseq N k.+1) e.
Proof. by rewrite /inside mkseqS !mem_rcons !inE => /andP [-> ->]; rewrite !orbT. Qed.
Lemma N_neq i k : i < k -> k < body_size B -> N k != N i.
Proof. by move=> ik kB; apply/eqP => /(N_inj kB (ltn_trans ik kB)) ki; rewrite ki ltnn in ik. Qed.
Lemma inside_out k e : k < body_size B -> inside (mkseq N k) e -> (e.1 != N k) && (e.2 != N k).
Proof.
by move=> kB /andP [/mapP [i + ->] /mapP [j + ->]]; rewrite !mem_iota => /= ik jk; rewrite ![_ == N k]eq_sym !N_neq.
Qed.
Lemma N_in k i : i < k -> N i \in mkseq N k.
Proof. by move=> ik; apply: map_f; rewrite mem_iota. Qed.

Definition shown k r := exists T : seq ('I_n * 'I_n),
  [/\ all (inside (mkseq N k)) T, all (either (U)) T & attained M T r].

Lemma shown_S k r : shown k r -> shown k.+1 r.
Proof. by case=> T [i e a]; exists T; split=> //; apply: sub_all i => e'; apply: inside_S. Qed.

Lemma joinedP l d acc r : shown (core_size B) l -> core_size B + d <= body_size B ->
  joined M allowed B d acc = Some r ->
  exists2 v, r = v + acc & shown (core_size B + d) (l + v).
Proof.
move=> base; elim: d acc => [|d ih] acc le /=; first by move=> [<-]; exists 0; rewrite ?addn0.
rewrite addnS in le *; set s := core_size B + d in le *.
case: (joins B s) => [|[t why] [|[t' why'] [|? ?]]] //.
- by case/(ih _ (ltnW le)) => v -> h; exists v => //; apply: shown_S.
- case: ifP => // ts; case: ifP => // ok /(ih _ (ltnW le)) [v -> [T [iT eT aT]]]; exists (v + one M); first by rewrite addnA.
  exists ((N s, N t) :: T); split.
  + rewrite /= {1}/inside /= !N_in // ?(ltnW ts) ?(leqW ts) //=; apply: sub_all iT => e'; exact: inside_S.
  + by apply/andP; split; [exact: allowedP ok | exact: eT].
  + rewrite addnA; apply: grow_one aT.
      exact: N_neq.
    by apply: sub_all iT => e'; apply: inside_out.
- case: ifP => // ts; case: ifP => // ts'; case: eqnP => // tt; case: ifP => // ok; case: ifP => // ok'.
  case/(ih _ (ltnW le)) => v -> [T [iT eT aT]]; exists (v + two M); first by rewrite addnA.
  exists ((N s, N t) :: (N s, N t') :: T); split.
  + rewrite /= {1 2}/inside /= !N_in ?(leqW ts) ?(leqW ts') //=; apply: sub_all iT => e'; exact: inside_S.
  + by apply/and3P; split; [exact: allowedP ok | exact: allowedP ok' | exact: eT].
  + rewrite addnA; apply: grow_two aT.
    * exact: N_neq.
    * exact: N_neq.
    * by apply/eqP => /(N_inj (ltn_trans ts le) (ltn_trans ts' le)).
    by apply: sub_all iT => e'; apply: inside_out.
Qed.

Lemma core_okP L : core_ok allowed B L ->
  all (fun e => (e.1.1 < core_size B) && (e.1.2 < core_size B)) (core_rows L) /\
  (forall e, e \in core_rows L -> either (U) (N e.1.1, N e.1.2)).
Proof.
elim: L => [|[[[i j] k] why] L ih] //=; case: ifP => // ic; case: ifP => // jc; case: ifP => // /allowedP ok.
case/ih => lt el; rewrite /= lt; split=> // e; rewrite inE => /predU1P [-> | /el] //.
Qed.

Lemma core_shown : core_size B <= body_size B -> core_ok allowed B (core B) ->
  shown (core_size B) (core_rank_in M (centre B) (core_size B) (core_rows (core B)) (flows B)).
Proof.
move=> le /core_okP [lt el]; have a := core_sound M (centre B) (flows B) lt.
pose s (i : 'I_(core_size B)) := N i.
have s_inj : injective s.
  by move=> i j /N_inj ij; apply/val_inj/ij; apply: leq_trans le.
exists (moved s (edges (core_size B) (pairs_of (core_rows (core B))))); split; last exact: attained_moved s_inj a.
  by apply/allP=> _ /mapP [[i j] _ ->]; rewrite /inside /= !N_in.
apply/allP=> _ /mapP [[i j] + ->] /=; rewrite mem_pmap => /mapP [[x y] /mapP [k kL xy]] /=.
case: insubP => // i' _ ex; case: insubP => // j' _ ey [-> ->].
by have := el _ kL; rewrite -xy /= -ex -ey.
Qed.
End Body.

Lemma nodes_okP k : nodes_ok n B k -> forall i, i < k -> node B i < n.
Proof.
elim: k => [|k ih] //=; case: ifP => // kn /ih {}ih i.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /ih].
Qed.

Lemma body_rankP r : body_rank M n allowed B = Some r -> shown (body_size B) r.
Proof.
rewrite /body_rank; case: ifP => // le; case: ifP => // /nodes_okP lt; case: ifP => // /increasingP u.
case: ifP => // ok; have base := core_shown u lt le ok.
by move/(joinedP u lt base) => []; rewrite subnKC // => v -> h; rewrite addnC.
Qed.
End Machine.

(* A motion that all pairs of the core allow, but that of its nodes i and j does not: that pair raises the rank. *)
Lemma body_motionP (allowed : nat -> nat -> reason -> bool) B U motion i j r :
  (forall x y why, allowed x y why -> either U (V x, V y)) -> body_rank M n allowed B = Some r ->
  all_allow M (centre B) motion (core_rows (core B)) -> i < core_size B -> j < core_size B ->
  ~~ allows M (centre B) motion i j ->
  exists T, [/\ all (inside (mkseq (fun k => V (node B k)) (body_size B))) T,
    all (either ((V (node B i), V (node B j)) :: U)) T & attained M T r.+1].
Proof.
move=> ok; rewrite /body_rank; case: ifP => // le; case: ifP => // /nodes_okP lt; case: ifP => // /increasingP u.
case: ifP => // cok.
move=> jo sol ic jc nij; set U' := _ :: U; have le' : core_size B + (body_size B - core_size B) <= body_size B by rewrite subnKC.
have ok' x y why : allowed x y why -> either U' (V x, V y).
  by move/ok; rewrite /either !inE => /orP [] ->; rewrite ?orbT.
suff base : shown B U' (core_size B) (core_rank_in M (centre B) (core_size B) (core_rows (core B)) (flows B)).+1.
  by have [v -> h] := joinedP ok' u lt base le' jo; move: h; rewrite subnKC // addSn addnC.
have [clt el] := core_okP ok' cok.
have a := core_motion (i := Ordinal ic) (j := Ordinal jc) (flows B) clt sol nij.
pose s (k : 'I_(core_size B)) := V (node B k).
have s_inj : injective s.
  by move=> k k' /(N_inj u lt) kk; apply/val_inj/kk; apply: leq_trans le.
exists (moved s ((Ordinal ic, Ordinal jc) :: edges (core_size B) (pairs_of (core_rows (core B))))); split.
- by apply/allP=> _ /mapP [[k k'] _ ->]; rewrite /inside /= !N_in.
- apply/allP=> _ /mapP [[k k'] + ->] /=; rewrite inE => /predU1P [[-> ->]|]; first by rewrite /either mem_head.
  rewrite mem_pmap => /mapP [[x y] /mapP [g gL xy]] /=.
  case: insubP => // k1 _ ex; case: insubP => // k2 _ ey [-> ->].
  by have := el _ gL; rewrite -xy /= -ex -ey.
- exact: attained_moved s_inj a.
Qed.

Lemma all_rigidP owner b r : all_rigid M n m first second bodies owner b -> attained M (usable b) r -> attained M (edges n G) r.
Proof.
elim: b => //= b ih; case: ifP => // rig /ih {}ih a; apply: ih; move: rig; rewrite /rigid.
case: ifP => // s1; case e: body_rank => [s|//] les; have [T [iT eT aT]] := body_rankP (@pair_okP _ b) e.
apply: (full (T := T) (b := nodes b)) a => //; first by rewrite size_mkseq.
- by apply/allP=> _ /allpairsP [[x y] [xb yb ->]]; rewrite /inside xb.
- by rewrite size_mkseq; apply: attained_less aT.
Qed.

Theorem lower_ok_sound owner b r : lower_ok M n m first second bodies owner b r -> rank_at_least M n G r.
Proof.
rewrite /lower_ok; case: ifP => // rig; case e: body_rank => [s|//] rs.
have [T [_ eT aT]] := body_rankP (@pair_okP _ b) e.
exact: attained_less rs (all_rigidP rig (attained_either eT aT)).
Qed.

Lemma edges_V e : e \in edges n G -> exists2 k, k < m & e = (V (first k), V (second k)).
Proof.
rewrite mem_pmap => /mapP [[x y] /mapP [k + [-> ->]] /=]; rewrite mem_iota => /= km.
case: insubP => // i lti ei; case: insubP => // j ltj ej [->]; exists k => //.
by congr (_, _); apply: val_inj; rewrite valV.
Qed.

(* Pairs in some sets have this rank at most, at all cameras. *)
Definition bounded (D : seq (seq 'I_n)) (u : nat) : Prop := forall E : seq ('I_n * 'I_n),
  all (fun e : 'I_n * 'I_n => has (fun b => inside b e) D) E -> at_most M E u.
Lemma bounded_nil : bounded [::] 0.
Proof. by case=> [|e E] // _; exact: at_most_nil. Qed.
Lemma bounded_set b : 1 < size b -> bounded [:: b] (required M (size b)).
Proof. by move=> s1 E cov; apply: at_most_inside => //; apply: sub_all cov => e /=; rewrite orbF. Qed.
Lemma bounded_cat D1 D2 u1 u2 : bounded D1 u1 -> bounded D2 u2 -> bounded (D1 ++ D2) (u1 + u2).
Proof.
move=> h1 h2 E /allP cov; pose E' D := [seq e : 'I_n * 'I_n <- E | has (fun b => inside b e) D].
apply: (@at_most_mono _ _ _ (E' D1 ++ E' D2)) => [e eE|].
  by have := cov e eE; rewrite has_cat mem_cat !mem_filter eE !andbT.
exact: at_most_cat (h1 _ (filter_all _ _)) (h2 _ (filter_all _ _)).
Qed.
Lemma bounded_flatten (I : Type) (L : seq I) D u : (forall i, bounded (D i) (u i)) ->
  bounded (flatten [seq D i | i <- L]) (\sum_(i <- L) u i).
Proof.
move=> h; elim: L => [|i L ih]; first by rewrite big_nil; apply: bounded_nil.
by rewrite big_cons; apply: bounded_cat.
Qed.

Section Upper.
Variables (sets : nat) (set_size : nat -> nat) (member : nat -> nat -> nat).
Variables (blocks : nat -> block) (half : nat) (shared : body) (place : nat -> option (nat * nat * (nat -> nat))).
Definition cell c d : seq 'I_n := mkseq (fun i => V (node_in (blocks c) d i)) (size_in (blocks c) d).
Definition of_block c : seq (seq 'I_n) := [seq cell c d | d <- iota 0 (cells_of (blocks c))].
Definition set_ k : seq 'I_n := mkseq (fun i => V (member k i)) (set_size k).
Local Notation A L := (flatten [seq of_block c | c <- L]).

Lemma of_blockP c u : block_bound M n (blocks c) = Some u -> bounded (of_block c) u.
Proof.
rewrite /block_bound /of_block /cell /cells_of /size_in /node_in; case: ifP => // _; case e: (hub (blocks c)) => [H|].
  rewrite /bounded /at_most; case: M => // b E cov F P; apply: (split_boundP (node := fun i => V (block_node (blocks c) i))) b _.
  by apply: sub_all cov => f; rewrite has_map.
case: ifP => // s1 [<-]; have := @bounded_set (mkseq (fun i => V (block_node (blocks c) i)) (block_size (blocks c))).
by rewrite size_mkseq => /(_ s1).
Qed.

Lemma iotaS b : iota 0 b.+1 = rcons (iota 0 b) b.
Proof. by rewrite -[b.+1]addn1 iotaD cats1. Qed.

Definition count c := odflt 0 (block_bound M n (blocks c)).
Lemma blocks_sumP b acc r : blocks_sum M n blocks b acc = Some r ->
  (forall c, c < b -> bounded (of_block c) (count c)) /\ r = \sum_(c <- iota 0 b) count c + acc.
Proof.
elim: b acc => [|b ih] acc; first by move=> [<-]; rewrite big_nil.
rewrite [blocks_sum _ _ _ _ _]/=; case e: block_bound => [u|//] /ih [a ->].
rewrite iotaS -cats1 big_cat big_seq1 /= /count e /= addnA; split=> // c.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /a //]; rewrite e; apply: of_blockP.
Qed.

Lemma in_cellP c d at_ k : in_cell member (blocks c) d at_ k (set_size k) -> {subset set_ k <= cell c d}.
Proof.
move=> h _ /mapP [i + ->]; rewrite mem_iota /=; elim: (set_size k) h => //= s ih.
rewrite /held; case: ifP => //; case: ifP => // lt /eqnP e /ih {}ih.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /ih //]; rewrite -e; apply: map_f; rewrite mem_iota.
Qed.

Lemma in_A c d L : c \in L -> d < cells_of (blocks c) -> cell c d \in A L.
Proof. by move=> cL dc; apply/flattenP; exists (of_block c); rewrite map_f // mem_iota. Qed.

Lemma placedP b k acc r : placed M set_size member blocks place b k acc = Some r -> exists L : seq (seq 'I_n), exists2 u,
  r = u + acc & bounded L u /\ forall i, i < k -> exists2 B, B \in A (iota 0 b) ++ L & {subset set_ i <= B}.
Proof.
elim: k acc => [|k ih] acc /=; first by move=> [<-]; exists [::], 0; rewrite ?add0n //; split=> //; apply: bounded_nil.
case: (place k) => [[[c d] at_]|].
  case: ifP => // cb; case: ifP => // dc; case: ifP => // /in_cellP sub.
  case/ih=> L [u -> [bd cov]]; exists L, u => //; split=> // i; rewrite ltnS leq_eqVlt => /predU1P [-> | /cov //].
  by exists (cell c d) => //; rewrite mem_cat in_A // mem_iota.
case: ifP => // s1 /ih [L [u -> [bd cov]]]; exists (set_ k :: L), (required M (set_size k) + u); first by rewrite addnCA addnA.
split.
  have := bounded_cat (@bounded_set (set_ k) _) bd; rewrite size_mkseq; apply.
  exact: s1.
move=> i; rewrite ltnS leq_eqVlt => /predU1P [-> | /cov [B BL sub]].
  by exists (set_ k) => //; rewrite mem_cat mem_head orbT.
by exists B => //; move: BL; rewrite !mem_cat inE => /orP [->|->]; rewrite ?orbT.
Qed.

(* the pairs of nodes that one of some sets holds; those that cells of both lists hold *)
Definition within_some (D : seq (seq 'I_n)) : seq ('I_n * 'I_n) :=
  [seq e : 'I_n * 'I_n <- enum {: 'I_n * 'I_n} | has (fun B => inside B e) D].
Local Notation first_list := (A (iota 0 half)).
Local Notation second_list c := (A (iota half (c - half))).
Definition both c : seq ('I_n * 'I_n) := [seq e <- within_some first_list | has (fun B => inside B e) (second_list c)].
Lemma within_someE D e : (e \in within_some D) = has (fun B => inside B e) D.
Proof. by rewrite mem_filter mem_enum andbT. Qed.
Lemma bothE c e : (e \in both c) = has (fun B => inside B e) first_list && has (fun B => inside B e) (second_list c).
Proof. by rewrite mem_filter within_someE andbC. Qed.

Lemma two_inP c d i j x y L : two_in blocks c d i j x y -> c \in L -> has (fun B => inside B (V x, V y)) (A L).
Proof.
rewrite /two_in /held; case: ifP => // dc; case: ifP => //; case: ifP => // ic /eqnP <-; case: ifP => // jc /eqnP <- cL.
by apply/hasP; exists (cell c d); [exact: in_A | apply/andP; split; apply: map_f; rewrite mem_iota].
Qed.

Lemma both_okP c x y why : both_ok blocks half c x y why -> either (both c) (V x, V y).
Proof.
case: why => //= d k s t d' k' s' t'; case: ifP => // dh; case: ifP => // hd; case: ifP => // dc.
case: ifP => // i1 i2; rewrite /either bothE; apply/orP; left.
rewrite (two_inP i1) ?mem_iota //= (two_inP i2) // mem_iota hd subnKC // (leq_trans hd) //; exact: ltnW.
Qed.

Lemma either_both c (e : 'I_n * 'I_n) : either (both c) e -> e \in both c.
Proof.
case: e => x y /orP [//|]; rewrite !bothE /swap /=.
by case/andP=> /hasP [B BA /andP [xB yB]] /hasP [B' BA' /andP [xB' yB']]; apply/andP; split; apply/hasP;
  [exists B | exists B'] => //; apply/andP.
Qed.

Theorem upper_ok_sound c r (E : seq ('I_n * 'I_n)) :
  upper_ok M n sets set_size member blocks half shared place c r ->
  (forall e, e \in E -> exists2 k, k < sets & inside (set_ k) e) -> at_most M E r.
Proof.
rewrite /upper_ok; case e: blocks_sum => [acc|//]; have [bc ->{acc e}] := blocks_sumP e => /=.
case e: placed => [s|//]; have [L [u -> [bL cov]]] := placedP e => {e s} + EC; rewrite addn0.
have cover f : f \in E -> has (fun B => inside B f) (A (iota 0 c) ++ L).
  by move/EC=> [] k /cov [B BA sub] /andP [xk yk]; apply/hasP; exists B; rewrite // /inside !sub.
have bounds l : {subset l <= iota 0 c} -> bounded (A l) (\sum_(k <- l) count k).
  elim: l => [|k l ih] lc; first by rewrite big_nil; apply: bounded_nil.
  rewrite big_cons; apply: bounded_cat; last by apply: ih => x xl; apply: lc; rewrite inE xl orbT.
  by apply: bc; have := lc k (mem_head _ _); rewrite mem_iota.
case: ifP => [hc|_ le]; last first.
  apply: at_most_less le _; rewrite addnC; apply: (bounded_cat (bounds _ _) bL) => //.
  exact/allP.
case e: body_rank => [l|//] le; have [T [_ eT aT]] := body_rankP (@both_okP c) e.
have cA : iota 0 c = iota 0 half ++ iota half (c - half) by rewrite -iotaD subnKC // ltnW.
have T1 : {subset T <= within_some (first_list ++ L)}.
  by move=> f /(allP eT)/either_both; rewrite bothE within_someE has_cat => /andP [->].
have T2 : {subset T <= within_some (second_list c)}.
  by move=> f /(allP eT)/either_both; rewrite bothE within_someE => /andP [_ ->].
have within D v : bounded D v -> at_most M (within_some D) v by move=> bD; apply: bD; apply: filter_all.
have s1 : {subset iota 0 half <= iota 0 c} by move=> x; rewrite cA mem_cat => ->.
have s2 : {subset iota half (c - half) <= iota 0 c} by move=> x; rewrite cA mem_cat orbC => ->.
have h := overlap T1 T2 aT (within _ _ (bounded_cat (bounds _ s1) bL)) (within _ _ (bounds _ s2)).
have sub : {subset E <= within_some (first_list ++ L) ++ within_some (second_list c)}.
  move=> f /cover; rewrite cA map_cat flatten_cat mem_cat !within_someE !has_cat.
  by case/orP=> [/orP [->|->]|->]; rewrite ?orbT.
apply: at_most_less (at_most_mono sub h); move: le; rewrite cA big_cat /=.
by move: (\sum_(k <- _) _) (\sum_(k <- iota half _) _) => x y; lia.
Qed.
End Upper.
End Sound.

(* no graph has a larger rank *)
Lemma at_most_all M n G : well_formed n G -> at_most M (edges n G) (required M n).
Proof.
case/and3P=> n1 _ _; have := @at_most_inside M n (enum 'I_n) (edges n G); rewrite size_enum_ord; apply=> //.
by apply/allP=> e _; rewrite /inside !mem_enum.
Qed.

Theorem verify_sound M n m first second by_pair bodies owner b lower blocks half shared c place upper :
  verify M n m first second by_pair bodies owner b lower blocks half shared c place upper ->
  let G := pairs m first second in
  [/\ well_formed n G, rank_at_least M n G lower & rank_at_most M n G upper].
Proof.
rewrite /verify; case: ifP => // /graph_ok_sound good; case: ifP => // lo up; split=> //.
  move: lo; rewrite /lower_part; case: eqnP => [-> _|_]; first exact: attained_zero.
  exact: (lower_ok_sound good).
move: up; rewrite /upper_part; case: ifP => [le _ | _ up]; last first.
  apply: (upper_ok_sound (good := good) up) => _ /(edges_V good) [k km ->]; exists k => //.
  by rewrite /inside /set_ /= !inE !eqxx orbT.
by have := at_most_less le (at_most_all M good).
Qed.

(* What the program prints, in the words of Statement.v *)
Section Corollaries.
Variables (M : model) (n : nat) (G : seq (nat * nat)).

Corollary exact_rank r : [/\ well_formed n G, rank_at_least M n G r & rank_at_most M n G r] -> generic_rank M n G r.
Proof. by []. Qed.

Corollary has_full_rank u :
  [/\ well_formed n G, rank_at_least M n G (required M n) & rank_at_most M n G u] -> full_rank M n G.
Proof. by case=> good low _; split=> //; have := at_most_all M good. Qed.

Corollary lacks_full_rank l u : u < required M n ->
  [/\ well_formed n G, rank_at_least M n G l & rank_at_most M n G u] -> ~ full_rank M n G.
Proof.
by move=> lt [_ _ up] [_ low _]; have := @at_most_attained M n (edges n G) _ _ up low; rewrite leqNgt lt.
Qed.
End Corollaries.
