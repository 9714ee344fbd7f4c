(* Section 6 as a program: that some bodies are all the components of the graph.

   Components are numbered so that those that are told apart last stand together. At first all of them are one interval;
   each step cuts an interval into smaller ones, until every component is alone. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From Viewcert Require Import Statement Counting Rigid Models Components Elimination Cores Checker.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

(* Intervals that share one node at most with those before (Theorem 4.3). For every node the interval in which it occurs
   first, by its beginning; for every interval the node, if any, that it has from earlier ones. *)
Record shared_nodes := SharedNodes { home : nat -> nat; attached : nat -> option nat }.

(* Intervals told apart by a motion (Theorem 6.4): a body with a core, and a motion of the core, in which nodes of
   different intervals move differently. What the interval counts is a bound that meets the rank of this body. *)
Record told_apart := ToldApart {
  frame : body; motion : nat -> nat;
  interval : nat -> nat;                                  (* of a component *)
  position : nat -> nat -> nat; place_there : nat -> nat -> nat; (* of its nodes in the frame, and of it there *)
  meeting : nat -> nat; there : nat -> nat -> nat;        (* the components at a position *)
  witness : nat -> nat -> nat * nat * nat * nat;          (* core nodes in two components: in the core, in the component *)
  blocks_ : nat -> block; block_count : nat; half_ : nat; shared_ : body; in_ : nat -> option (nat * nat * (nat -> nat)) }.

(* ends of the intervals *)
Inductive step := Cut of seq nat & shared_nodes | Apart of seq nat & told_apart.

Section Program.
Variables (M : model) (n m : nat) (first second : nat -> nat) (bodies : nat -> body) (b : nat).
Variables (owner : nat -> nat) (in_owner : nat -> nat -> nat).
Variables (t : nat) (comp : nat -> nat) (pair_at : nat -> nat * nat * nat).

(* nodes of a body are nodes of its owner *)
Fixpoint in_owner_ok c s : bool :=
  if s is s'.+1 then
    let q := in_owner c s' in
    if q < body_size (bodies (owner c)) then
      if eqn (node (bodies (owner c)) q) (node (bodies c) s') then in_owner_ok c s' else false
    else false
  else true.
Fixpoint owners_ok k : bool :=
  if k is k'.+1 then if in_owner_ok k' (body_size (bodies k')) then owners_ok k' else false else true.
Fixpoint comps_ok k : bool :=
  if k is k'.+1 then
    if comp k' < b then if eqn (owner (comp k')) (comp k') then comps_ok k' else false else false
  else true.

Definition size_of k := body_size (bodies (comp k)).
Definition node_of k s := node (bodies (comp k)) s.
Definition holds k s x : bool := if s < size_of k then eqn (node_of k s) x else false.

Fixpoint pairs_at_ok k : bool :=
  if k is k'.+1 then
    let: (c, s, s') := pair_at k' in
    if c < t then
      if holds c s (first k') then if holds c s' (second k') then pairs_at_ok k' else false else false
    else false
  else true.

Section Cut.
Variable H : shared_nodes.
Definition node_ok lo x : bool :=
  if attached H lo is Some w then if eqn x w then home H w < lo else eqn (home H x) lo else eqn (home H x) lo.
Fixpoint nodes_at lo k s : bool :=
  if s is s'.+1 then if node_ok lo (node_of k s') then nodes_at lo k s' else false else true.
Fixpoint cell_ok lo d : bool :=
  if d is d'.+1 then if nodes_at lo (lo + d') (size_of (lo + d')) then cell_ok lo d' else false else true.
Fixpoint cut_ok lo (xs : seq nat) hi : bool :=
  if xs is x :: xs' then if lo < x then if cell_ok lo (x - lo) then cut_ok x xs' hi else false else false else eqn lo hi.
End Cut.

Section Apart.
Variables (a : nat) (hi : nat) (K : told_apart).
Definition pair_in x y (why : reason) : bool :=
  if why is Inside c s s' then
    if a <= c then if c < hi then if holds c s x then holds c s' y else false else false else false
  else false.

Fixpoint labels lo d : bool := if d is d'.+1 then if eqn (interval K (lo + d')) lo then labels lo d' else false else true.
Fixpoint labels_ok lo (xs : seq nat) : bool :=
  if xs is x :: xs' then if lo < x then if labels lo (x - lo) then labels_ok x xs' else false else false else eqn lo hi.

Fixpoint positions k s : bool :=
  if s is s'.+1 then
    let q := position K k s' in
    if q < body_size (frame K) then
      if eqn (node (frame K) q) (node_of k s') then
        if place_there K k s' < meeting K q then
          if eqn (there K q (place_there K k s')) k then positions k s' else false
        else false
      else false
    else false
  else true.
Fixpoint positions_ok d : bool :=
  if d is d'.+1 then if positions (a + d') (size_of (a + d')) then positions_ok d' else false else true.

Definition differ c d : bool :=
  if eqn (interval K c) (interval K d) then true
  else let: (i, s, j, s') := witness K c d in
    if i < core_size (frame K) then
      if j < core_size (frame K) then
        if holds c s (node (frame K) i) then
          if holds d s' (node (frame K) j) then
            if allows M (centre (frame K)) (motion K) i j then false else true
          else false
        else false
      else false
    else false.
Fixpoint differ_before q c j : bool :=
  if j is j'.+1 then if differ c (there K q j') then differ_before q c j' else false else true.
Fixpoint differ_at q i : bool :=
  if i is i'.+1 then if differ_before q (there K q i') i' then differ_at q i' else false else true.
Fixpoint differ_ok q : bool :=
  if q is q'.+1 then if differ_at q' (meeting K q') then differ_ok q' else false else true.

Definition apart_ok xs : bool :=
  if body_rank M n pair_in (frame K) is Some r then
    if upper_ok M n (hi - a) (fun k => size_of (a + k)) (fun k => node_of (a + k)) (blocks_ K) (half_ K) (shared_ K) (in_ K)
         (block_count K) r then
      if all_allow M (centre (frame K)) (motion K) (core_rows (core (frame K))) then
        if labels_ok a xs then
          if positions_ok (hi - a) then differ_ok (body_size (frame K)) else false
        else false
      else false
    else false
  else false.
End Apart.

(* intervals with two components or more *)
Fixpoint cells lo (xs : seq nat) (P : seq (nat * nat)) : seq (nat * nat) :=
  if xs is x :: xs' then cells x xs' (if lo.+1 < x then (lo, x) :: P else P) else P.
Fixpoint steps_ok (S : seq step) (P : seq (nat * nat)) : bool :=
  match P with
  | [::] => if S is [::] then true else false
  | (lo, hi) :: P' =>
    match S with
    | [::] => false
    | Cut xs H :: S' => if cut_ok H lo xs hi then steps_ok S' (cells lo xs P') else false
    | Apart xs K :: S' => if apart_ok lo hi K xs then steps_ok S' (cells lo xs P') else false
    end
  end.

(* if bodies 0 .. b-1 are rigid *)
Definition components_ok (S : seq step) : bool :=
  if owners_ok b then
    if comps_ok t then
      if pairs_at_ok m then steps_ok S (cells 0 [:: t] [::]) else false
    else false
  else false.
End Program.

(* ------------------------------------------------------------------ its soundness *)
Section Sound.
Variables (M : model) (n m : nat) (first second : nat -> nat) (bodies : nat -> body) (b : nat).
Variables (owner : nat -> nat) (in_owner : nat -> nat -> nat).
Variables (t : nat) (comp : nat -> nat) (pair_at : nat -> nat * nat * nat).
Local Notation G := (pairs m first second).
Hypothesis good : well_formed n G.
Local Notation V := (V good).
Local Notation E := (edges n G).
Local Notation nodes := (nodes bodies good).
Local Notation nodes_of k := (nodes (comp k)).
Local Notation all_pairs := Components.all_pairs.

Hypothesis all_rig : all_rigid M n m first second bodies owner b.

Lemma rigidP c : c < b -> rigid M n m first second bodies owner c.
Proof.
elim: b all_rig => //= k ih; case: ifP => // rk /ih {}ih.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /ih].
Qed.

Lemma body_factsP c : c < b -> [/\ 1 < body_size (bodies c), uniq (nodes c)
  & forall s, s < body_size (bodies c) -> node (bodies c) s < n].
Proof.
move/rigidP; rewrite /rigid; case: ifP => // s1; case e: body_rank => [r|//] _.
move: e; rewrite /body_rank; case: ifP => // _; case: ifP => // /nodes_okP lt; case: ifP => // /increasingP u _.
split=> //; apply/(mkseq_uniqP _ _) => i j; rewrite !inE => ib jb /(congr1 val); rewrite !valV ?lt //.
exact: (mkseq_uniqP _ _ u).
Qed.

(* the bodies before k that o owns *)
Fixpoint owned o k : seq ('I_n * 'I_n) :=
  if k is k'.+1 then (if owner k' == o then all_pairs (nodes k') else [::]) ++ owned o k' else [::].
Lemma owned_in o k c e : c < k -> owner c = o -> inside (nodes c) e -> e \in owned o k.
Proof.
move=> + oc ce; elim: k => //= k ih; rewrite ltnS leq_eqVlt mem_cat => /predU1P [<-|/ih ->]; last by rewrite orbT.
by rewrite oc eqxx all_pairsE ce.
Qed.

Lemma mate_okP o c x y why : owner c = o -> pair_ok m first second bodies (fun k => eqn (owner k) (owner c)) c x y why ->
  either (owned o c ++ E) (V x, V y).
Proof.
move=> oc; case: why => [k | k s s' | //] /=.
  case: ifP => // /(edge_of good) kE; case: eqnP => [<- /eqnP <- | _]; first by rewrite /either mem_cat kE orbT.
  by case: eqnP => // <- /eqnP <-; rewrite /either /swap /= !mem_cat kE !orbT.
case: ifP => // kc; case: eqnP => // ok; case: ifP => // sk; case: ifP => // sk'; case: eqnP => // <- /eqnP <-.
apply/orP; left; rewrite mem_cat; apply/orP; left; apply: owned_in kc _ _; first by rewrite ok.
by apply/andP; split; apply: map_f; rewrite mem_iota.
Qed.

Hypothesis owners : owners_ok bodies owner in_owner b.
Lemma in_ownerP c : c < b -> {subset nodes c <= nodes (owner c)}.
Proof.
elim: b owners => //= k ih; case: ifP => // ok /ih {}ih.
rewrite ltnS leq_eqVlt => /predU1P [-> | /ih //].
move=> _ /mapP [i + ->]; rewrite mem_iota /=; elim: (body_size (bodies k)) ok => //= s ih'.
case: ifP => // lt; case: eqnP => // e /ih' {}ih'; rewrite ltnS leq_eqVlt => /predU1P [-> | /ih' //].
by rewrite -e; apply: map_f; rewrite mem_iota.
Qed.

Lemma inside_owner c e : c < b -> inside (nodes c) e -> inside (nodes (owner c)) e.
Proof. by move=> cb /andP [c1 c2]; apply/andP; split; apply: in_ownerP. Qed.

(* what a body shows holds for the pairs of the graph in its owner, and the earlier bodies there *)
Lemma shown_in o c : c < b -> owner c = o -> exists T, [/\ all (inside (nodes c)) T,
  all (either (owned o c ++ induced E (nodes o))) T & attained M T (required M (size (nodes c)))].
Proof.
move=> cb oc; have := rigidP cb; rewrite /rigid; case: ifP => // _; case e: body_rank => [s|//] le.
have [T [iT eT aT]] := body_rankP (fun x y why => @mate_okP o c x y why oc) e.
exists T; split=> //; last by rewrite size_mkseq; exact: attained_less aT.
apply/allP=> f fT; have fo : inside (nodes o) f by rewrite -oc inside_owner // (allP iT).
have := allP eT f fT; rewrite /either !mem_cat !mem_filter fo.
by have -> : inside (nodes o) (swap f) by rewrite /inside andbC.
Qed.

Lemma owned_drop o k r : k <= b -> attained M (owned o k ++ induced E (nodes o)) r ->
  attained M (induced E (nodes o)) r.
Proof.
elim: k => //= k ih kb a; apply: ih; first exact: ltnW.
move: a; case: eqP => // ok; rewrite -catA => a.
have [T [iT eT aT]] := shown_in kb ok; have [s1 _ _] := body_factsP kb.
apply: (full (T := T) (b := nodes k)) a => //; first by rewrite size_mkseq.
by apply/allP=> f; rewrite all_pairsE.
Qed.

Hypothesis comps : comps_ok b owner comp t.
Lemma compP k : k < t -> comp k < b /\ owner (comp k) = comp k.
Proof.
elim: t comps => //= i ih; case: ifP => // ib; case: eqnP => // oi /ih {}ih.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /ih].
Qed.

Lemma comp_rigid k : k < t -> rigid_part M E (nodes_of k).
Proof.
case/compP=> kb ok; have [s1 u _] := body_factsP kb; have [T [_ eT aT]] := shown_in kb ok.
split; rewrite ?size_mkseq //; move: aT; rewrite size_mkseq => /(attained_either eT).
by apply: owned_drop; apply: ltnW.
Qed.

Hypothesis covers : pairs_at_ok first second bodies t comp pair_at m.
Lemma holdsP k s x : holds bodies comp k s x -> s < size_of bodies comp k /\ node_of bodies comp k s = x.
Proof. by rewrite /holds; case: ifP => // sk /eqnP. Qed.
Lemma holds_in k s x : holds bodies comp k s x -> V x \in nodes_of k.
Proof. by case/holdsP=> sk <-; apply: map_f; rewrite mem_iota. Qed.
Lemma comp_cover e : e \in E -> exists2 k, k < t & inside (nodes_of k) e.
Proof.
case/(edges_V good) => k km ->; suff h j : pairs_at_ok first second bodies t comp pair_at j -> forall k, k < j ->
  exists2 c, c < t & inside (nodes_of c) (V (first k), V (second k)) by exact: h covers k km.
elim: j {k km} => //= i ih; case: (pair_at i) => [[c s] s']; case: ifP => // ct; case: ifP => // /holds_in h1; case: ifP => // /holds_in h2 /ih {}ih k.
by rewrite ltnS leq_eqVlt => /predU1P [-> | /ih //]; exists c; rewrite // /inside h1.
Qed.

Local Notation closed := (closed M E t (fun k => nodes_of k)).
Definition between lo hi : pred nat := fun k => lo <= k < hi.
Lemma loopfree (e : 'I_n * 'I_n) : e \in E -> e.1 != e.2.
Proof. by rewrite edgesE; case/and3P: good => _ /allP lt _ /lt /andP [/= e12 _]; rewrite -val_eqE neq_ltn e12. Qed.

Lemma closed_ext q q' : q =1 q' -> closed q -> closed q'.
Proof. by move=> e c B k l rB kt lt; rewrite -!e; apply: c. Qed.

(* intervals and their cells *)
Fixpoint all_cells lo (xs : seq nat) : seq (nat * nat) := if xs is x :: xs' then (lo, x) :: all_cells x xs' else [::].

Section Cut.
Variable H : shared_nodes.
Lemma cell_okP lo hi : lo <= hi -> cell_ok bodies comp H lo (hi - lo) -> forall k s, between lo hi k -> s < size_of bodies comp k ->
  node_ok H lo (node_of bodies comp k s).
Proof.
move=> le; rewrite -{2}(subnKC le); elim: (hi - lo) => [|d ih] /=; first by move=> _ k s; rewrite /between; lia.
case: ifP => // ok /ih {}ih k s; rewrite /between addnS ltnS => /andP [lk]; rewrite leq_eqVlt => /predU1P [-> | kd].
  elim: (size_of _ _ _) ok => //= s' ih'; case: ifP => // h /ih' {}ih'.
  by rewrite ltnS leq_eqVlt => /predU1P [-> | /ih'].
by apply: ih; rewrite /between lk.
Qed.

Lemma cut_okP a lo xs hi : hi <= t -> a <= lo -> cut_ok bodies comp H lo xs hi -> closed (between a hi) ->
  (forall k s, between a lo k -> s < size_of bodies comp k -> home H (node_of bodies comp k s) < lo) ->
  closed (between a lo) /\ (forall c, c \in all_cells lo xs -> closed (between c.1 c.2)).
Proof.
move=> hit; elim: xs lo => [|x xs ih] lo al /=; first by move=> /eqnP -> c _; split.
case: ifP => // lx; case: ifP => // /(cell_okP (ltnW lx)) ok next c homes.
have homes' k s : between a x k -> s < size_of bodies comp k -> home H (node_of bodies comp k s) < x.
  move=> /andP [ak kx] sk; case: (ltnP k lo) => [kl|lk].
    by apply: ltn_trans lx; apply: homes; rewrite // /between ak.
  have /(ok k s) : between lo x k by rewrite /between lk.
  move/(_ sk); rewrite /node_ok; case: attached => [w|/eqnP ->] //.
  by case: eqnP => [-> hw|_ /eqnP -> //]; apply: ltn_trans lx.
have [cx cells] := ih x (leq_trans al (ltnW lx)) next c homes'.
have xt k : between a x k -> k < x by case/andP.
pose w := if attached H lo is Some w then w else n.
have one k l v : k < t -> l < t -> between lo x k -> between a lo l -> v \in nodes_of k -> v \in nodes_of l -> val v = w.
  move=> kt lt kx la /mapP [s + ->] /mapP [s' + vv]; rewrite !mem_iota /= => sk sl.
  have [kb _] := compP kt; have [lb _] := compP lt.
  have [_ _ ltk] := body_factsP kb; have [_ _ ltl] := body_factsP lb.
  have same : node_of bodies comp k s = node_of bodies comp l s'.
    by move/(congr1 val): vv; rewrite !valV ?ltk ?ltl.
  have := homes l s' la sl; rewrite -same => hl; rewrite valV ?ltk //.
  have := ok k s kx sk; rewrite /node_ok /w; case: attached => [w'|/eqnP e]; last by rewrite -/(node_of _ _ _ _) e ltnn in hl.
  by case: eqnP => // _ /eqnP e; rewrite e ltnn in hl.
have xa k : between lo x k -> between a x k by case/andP=> lk kx; rewrite /between kx (leq_trans al).
have la k : between a lo k -> between a x k by case/andP=> ak kl; rewrite /between ak (ltn_trans kl).
have rest k : between a x k -> ~~ between lo x k -> between a lo k by rewrite /between; lia.
have rest' k : between a x k -> ~~ between a lo k -> between lo x k by rewrite /between; lia.
pose W : 'I_n := V w.
have oneW k l v : k < t -> l < t -> between lo x k -> between a lo l -> v \in nodes_of k -> v \in nodes_of l -> v = W.
  move=> kt lt kx la' vk vl; have e := one k l v kt lt kx la' vk vl.
  by apply: val_inj; rewrite valV -e ?ltn_ord.
split=> [|d].
  apply: (cut loopfree comp_cover (w := W) cx la) => k l v kt lt ka lx' /(rest' _ lx') {}lx' vk vl; exact: (oneW l k).
rewrite inE => /predU1P [-> /= |]; last exact: cells.
by apply: (cut loopfree comp_cover (w := W) cx xa) => k l v kt lt ka lx' /(rest _ lx') {}lx' vk vl; apply: (oneW k l).
Qed.
End Cut.

Section Apart.
Variables (a hi : nat) (K : told_apart).
Hypothesis hit : hi <= t.
Local Notation span := (between a hi).
Local Notation D := (pairs_of_kind E t (fun k => nodes_of k) span).
Local Notation U := (flatten [seq all_pairs (nodes_of k) | k <- iota a (hi - a)]).

Lemma in_span k : between a hi k -> k \in iota a (hi - a).
Proof. by rewrite mem_iota /between => /andP [ak kh]; rewrite ak subnKC // (leq_trans ak) // ltnW. Qed.
Lemma spanned k : k \in iota a (hi - a) -> between a hi k.
Proof. by rewrite mem_iota /between; lia. Qed.

Lemma pair_inP x y why : pair_in bodies comp a hi x y why -> either U (V x, V y).
Proof.
case: why => //= c s s'; case: ifP => // ac; case: ifP => // ch; case: ifP => // /holds_in h1 /holds_in h2.
apply/orP; left; apply/flattenP; exists (all_pairs (nodes_of c)); last by rewrite all_pairsE /inside h1.
by apply: map_f; apply: in_span; rewrite /between ac.
Qed.

Lemma drop_span X r : {subset D <= X} -> attained M (U ++ X) r -> attained M X r.
Proof.
have : all (fun k => k \in iota a (hi - a)) (iota a (hi - a)) by apply/allP.
elim: {2 3}(iota a (hi - a)) => //= k ks ih /andP [kin ksin] DX; rewrite -catA => h; apply: ih => //.
have kh := spanned kin; have kt : k < t by case/andP: kh => _ /leq_trans; apply.
have [s1 _ fullk] := comp_rigid kt.
apply: (full (T := induced E (nodes_of k)) (b := nodes_of k)) fullk h => //.
- apply/allP=> e; rewrite mem_filter => /andP [ke eE]; rewrite /either mem_cat DX ?orbT //.
  by rewrite mem_filter eE andbT; apply/kindP; exists k.
- exact: filter_all.
- by apply/allP=> e; rewrite all_pairsE.
Qed.

Lemma labels_okP lo xs : labels_ok hi K lo xs -> [/\ lo <= hi, forall k, between lo hi k -> lo <= interval K k
  & forall c, c \in all_cells lo xs -> [/\ lo <= c.1, c.1 < c.2, c.2 <= hi &
      forall k, between lo hi k -> (interval K k == c.1) = between c.1 c.2 k]].
Proof.
elim: xs lo => [|x xs ih] lo /=; first by move=> /eqnP <-; split=> // k; rewrite /between; lia.
case: ifP => // lx; case: ifP => // lab /ih [xh high cells].
have here k : between lo x k -> interval K k = lo.
  move: lab; rewrite /between -{2}(subnKC (ltnW lx)); elim: (x - lo) => [|d ih'] /=; first by lia.
  case: eqnP => // e /ih' {}ih' /andP [lk]; rewrite addnS ltnS leq_eqVlt => /predU1P [-> //|kd].
  by apply: ih'; rewrite lk.
have all_high k : between lo hi k -> lo <= interval K k /\ (x <= k -> x <= interval K k).
  move=> /andP [lk kh]; case: (ltnP k x) => [kx|xk]; first by rewrite here ?leqnn // /between lk.
  have := high k; rewrite /between xk kh => /(_ isT) xi; split=> //; exact: leq_trans (ltnW lx) xi.
split=> [|k /all_high [] //|c]; first exact: leq_trans (ltnW lx) xh.
rewrite inE => /predU1P [-> /= | /cells [xc cc ch lab']].
  split=> // k lk; have [_ up] := all_high k lk; case: (ltnP k x) => kx.
    by rewrite here /between ?eqxx ?kx ?andbT; case/andP: lk.
  by rewrite /between ltnNge kx andbF; apply/negbTE; have := up kx; rewrite neq_ltn => /(leq_trans lx) ->; rewrite orbT.
split=> // [|k lk]; first exact: leq_trans (ltnW lx) xc.
case: (ltnP k x) => kx; last by apply: lab'; rewrite /between kx; case/andP: lk.
rewrite here ?/between ?kx ?andbT; last by case/andP: lk.
by rewrite (ltn_eqF (leq_trans lx xc)) leqNgt (leq_trans kx xc).
Qed.

Lemma positions_okP d : positions_ok bodies comp a K d -> forall k s, a <= k < a + d -> s < size_of bodies comp k ->
  let q := position K k s in
  [/\ q < body_size (frame K), node (frame K) q = node_of bodies comp k s,
    place_there K k s < meeting K q & there K q (place_there K k s) = k].
Proof.
elim: d => [|d ih] /=; first by lia.
case: ifP => // ok /ih {}ih k s; rewrite addnS ltnS => /andP [ak]; rewrite leq_eqVlt => /predU1P [->|kd]; last first.
  by apply: ih; rewrite ak.
elim: (size_of _ _ _) ok => //= s' ih'; case: ifP => // q1; case: eqnP => // q2; case: ifP => // q3; case: eqnP => // q4.
by move/ih' => {}ih'; rewrite ltnS leq_eqVlt => /predU1P [-> | /ih'].
Qed.

Lemma differ_okP Q : differ_ok M bodies comp K Q -> forall q i j, q < Q -> i < meeting K q -> j < i ->
  differ M bodies comp K (there K q i) (there K q j).
Proof.
elim: Q => //= Q ih; case: ifP => // ok /ih {}ih q i j; rewrite ltnS leq_eqVlt => /predU1P [-> {q ih}|qQ]; last exact: ih.
elim: (meeting K Q) ok => //= k ih; case: ifP => // ok /ih {}ih; rewrite ltnS leq_eqVlt => /predU1P [-> {i ih}|]; last exact: ih.
move: (there K Q k) ok => c; elim: k => //= k ih; case: ifP => // ok /ih {}ih.
by rewrite ltnS leq_eqVlt => /predU1P [-> //|/ih].
Qed.

Theorem apart_okP xs : apart_ok M n bodies comp a hi K xs -> closed span ->
  forall c, c \in all_cells a xs -> closed (between c.1 c.2).
Proof.
rewrite /apart_ok; case e: body_rank => [r|//]; case: ifP => // up; case: ifP => // sol.
case: ifP => // /labels_okP [ah _ cells]; case: ifP => // /positions_okP pos /differ_okP diff cl c cin.
have [ac cc chi lab] := cells c cin.
have facts k : k < t -> forall s, s < size_of bodies comp k -> node_of bodies comp k s < n.
  by case/compP=> kb _; case: (body_factsP kb).
have le : at_most M D r.
  apply: (upper_ok_sound (good := good) up) => f; rewrite mem_filter.
  case/andP=> /kindP [k [kt /andP [ak kh] kf]] _; exists (k - a); first by rewrite ltn_sub2r // (leq_ltn_trans ak).
  by rewrite /set_ subnKC.
have raised k l : k < t -> l < t -> differ M bodies comp K k l -> interval K k != interval K l ->
    exists x y, [/\ x \in nodes_of k, y \in nodes_of l & attained M ((x, y) :: D) r.+1].
  move=> kt lt; rewrite /differ; case: eqnP => [->|_]; first by rewrite eqxx.
  case: witness => [[[i s] j] s']; case: ifP => // ic; case: ifP => // jc; case: ifP => // h1; case: ifP => // h2.
  case: ifP => // /negbT nij _ _; exists (V (node (frame K) i)), (V (node (frame K) j)); split; [exact: holds_in h1 | exact: holds_in h2 |].
  have [T [_ eT aT]] := body_motionP pair_inP e sol ic jc nij.
  apply: drop_span => [f fD|]; first by rewrite inE fD orbT.
  apply: attained_mono (attained_either eT aT) => f; rewrite !(inE, mem_cat) => /orP [->|->] //; by rewrite orbT.
apply: (separated loopfree comp_rigid comp_cover cl _ le) => [k /andP [ck kc] | k l v kt lt kc la lc vk vl].
  by rewrite /between (leq_trans ac ck) (leq_trans kc).
have ka : between a hi k by case/andP: kc => ck kc; rewrite /between (leq_trans ac ck) (leq_trans kc).
have nkl : interval K k != interval K l.
  by have := lab k ka; rewrite kc => /eqP ->; rewrite eq_sym lab.
move: vk vl => /mapP [s + ->] /mapP [s' +]; rewrite !mem_iota /= => sk sl.
move/(congr1 val); rewrite !valV ?facts // => same.
have kd j : between a hi j -> a <= j < a + (hi - a) by rewrite subnKC.
have [q1 q2 q3 q4] := pos k s (kd k ka) sk; have [p1 p2 p3 p4] := pos l s' (kd l la) sl.
have uniq_frame : uniq (mkseq (node (frame K)) (body_size (frame K))).
  by move: e; rewrite /body_rank; case: ifP => // _; case: ifP => // _; case: ifP => // /increasingP.
have qq : position K k s = position K l s'.
  by apply: (mkseq_uniqP _ _ uniq_frame) => //; rewrite q2 p2.
rewrite -qq in p1 p2 p3 p4.
case: (ltngtP (place_there K k s) (place_there K l s')) => ij; last by move: nkl; rewrite -{1}q4 ij p4 eqxx.
  have := diff _ _ _ q1 p3 ij; rewrite p4 q4 => /raised [] //; first by rewrite eq_sym.
  move=> y [x [yl xk up']]; exists x, y; split; [exact: xk | exact: yl | apply: attained_either up'].
  apply/allP=> f; rewrite !inE => /predU1P [->|fD]; first by rewrite /either /swap !inE eqxx !orbT.
  by rewrite /either inE fD orbT.
by have := diff _ _ _ q1 q3 ij; rewrite p4 q4 => dkl; apply: raised.
Qed.
End Apart.

Lemma cell_bounds lo xs hi c : (forall d, d \in all_cells lo xs -> d.1 < d.2 <= hi) -> c \in all_cells lo xs -> c.2 <= hi.
Proof. by move=> h /h /andP []. Qed.

(* what is known of a list of intervals: each is closed, and every component is alone or in one of them *)
Definition alone k := closed (pred1 k).
Definition progress (P : seq (nat * nat)) := (forall c, c \in P -> c.2 <= t /\ closed (between c.1 c.2)) /\
  (forall k, k < t -> alone k \/ exists2 c, c \in P & between c.1 c.2 k).

Lemma cells_in lo xs P c : (c \in cells lo xs P) = (c \in [seq d <- all_cells lo xs | d.1.+1 < d.2]) || (c \in P).
Proof.
elim: xs lo P => //= x xs ih lo P; rewrite ih; case: ifP => //= _.
by rewrite !inE orbA; congr (_ || _); rewrite orbC.
Qed.

(* the cells of an interval are all of it *)
Fixpoint covers_all lo (xs : seq nat) hi : bool := if xs is x :: xs' then (lo < x) && covers_all x xs' hi else lo == hi.
Lemma covers_allP lo xs hi : covers_all lo xs hi -> lo <= hi /\ (forall c, c \in all_cells lo xs -> c.2 <= hi)
  /\ (forall k, between lo hi k -> exists2 c, c \in all_cells lo xs & between c.1 c.2 k).
Proof.
elim: xs lo => [|x xs ih] lo /=; first by move/eqP=> ->; split=> //; split=> // k; rewrite /between; lia.
case/andP=> lx /ih [xh [ends all_]]; split; first exact: leq_trans (ltnW lx) xh.
split=> [c | k /andP [lk kh]]; first by rewrite inE => /predU1P [-> | /ends].
case: (ltnP k x) => kx; first by exists (lo, x); rewrite ?mem_head // /between lk.
by have [|c cin kc] := all_ k; [rewrite /between kx | exists c; rewrite // inE cin orbT].
Qed.
Lemma cut_covers H lo xs hi : cut_ok bodies comp H lo xs hi -> covers_all lo xs hi.
Proof. by elim: xs lo => [|x xs ih] lo /=; [move/eqnP=> ->|case: ifP => // _; case: ifP => // _ /ih]. Qed.
Lemma labels_cover hi K lo xs : labels_ok hi K lo xs -> covers_all lo xs hi.
Proof. by elim: xs lo => [|x xs ih] lo /=; [move/eqnP=> ->|case: ifP => // _; case: ifP => // _ /ih]. Qed.

Lemma progress_cells lo hi xs P : covers_all lo xs hi -> (forall c, c \in all_cells lo xs -> closed (between c.1 c.2)) ->
  progress ((lo, hi) :: P) -> progress (cells lo xs P).
Proof.
move=> /covers_allP [_ [ends all_]] cl [known every]; have [hit _] := known _ (mem_head _ _); split=> [c | k kt].
  rewrite cells_in mem_filter => /orP [/andP [_ cin] | cP]; last by apply: known; rewrite inE cP orbT.
  by split; [exact: leq_trans (ends c cin) hit | exact: cl].
case: (every k kt) => [|[c]]; first by left.
rewrite inE => /predU1P [-> /all_ [d din kd] | cP kc]; last by right; exists c; rewrite // cells_in cP orbT.
case: (ltnP d.1.+1 d.2) => dd; first by right; exists d; rewrite // cells_in mem_filter dd din.
left; apply: closed_ext (cl d din) => j; move: kd dd; rewrite /between /= => /andP [] *; apply/idP/eqP; lia.
Qed.

Theorem steps_okP S P : steps_ok M n bodies comp S P -> progress P -> forall k, k < t -> alone k.
Proof.
elim: S P => [|st S ih] [|[lo hi] P] //=.
  by move=> _ [_ every] k /every [|[]].
move=> ok pr; have [/(_ _ (mem_head _ _)) [/= hit cl] _] := pr.
case: st ok => [xs H | xs K]; case: ifP => // ok; move/ih; apply.
  apply: progress_cells (cut_covers ok) _ pr.
  by have [|_] := cut_okP hit (leqnn lo) ok cl; first by move=> k s; rewrite /between; lia.
apply: progress_cells _ (apart_okP hit ok cl) pr.
by move: ok; rewrite /apart_ok; case: body_rank => // r; case: ifP => // _; case: ifP => // _; case: ifP => // /labels_cover.
Qed.
End Sound.

Theorem components_ok_sound M n m first second bodies b owner in_owner t comp pair_at S :
  well_formed n (pairs m first second) -> all_rigid M n m first second bodies owner b ->
  components_ok M n m first second bodies b owner in_owner t comp pair_at S ->
  components M n (pairs m first second)
    [seq mkseq (node (bodies (comp k))) (body_size (bodies (comp k))) | k <- iota 0 t].
Proof.
move=> good rig; rewrite /components_ok; case: ifP => // own; case: ifP => // cmp; case: ifP => // cov ok.
have -> : [seq mkseq (node (bodies (comp k))) (body_size (bodies (comp k))) | k <- iota 0 t]
    = [seq map val (nodes bodies good (comp k)) | k <- iota 0 t].
  apply/eq_in_map=> k; rewrite mem_iota /= => kt; have [kb _] := compP cmp kt; have [_ _ lt] := body_factsP good rig kb.
  by rewrite /mkseq -map_comp; apply/eq_in_map=> s; rewrite mem_iota /= => sk; rewrite valV // lt.
apply: components_are => // [k kt | e eE | ].
- exact: (comp_rigid good rig own cmp kt).
- exact: (comp_cover good cov eE).
suff pr : progress M bodies t comp good (cells 0 [:: t] [::]) by move=> k kt; exact: (steps_okP rig own cmp cov ok pr kt).
split=> [c | k kt].
  by rewrite /=; case: ifP => // _; rewrite inE => /eqP ->; split=> // B k l _ _ lt _; rewrite /between /= lt.
rewrite /=; case: ifP => t1; first by right; exists (0, t); rewrite ?inE.
left=> B j l _ jt lt /eqP jk /eqP lk; lia.
Qed.

(* The program: bounds, and then components. *)
Theorem verify_components M n m first second by_pair bodies owner b lower blocks half shared c place upper in_owner t comp pair_at S :
  verify M n m first second by_pair bodies owner b lower blocks half shared c place upper -> 0 < lower ->
  components_ok M n m first second bodies b owner in_owner t comp pair_at S ->
  components M n (pairs m first second)
    [seq mkseq (node (bodies (comp k))) (body_size (bodies (comp k))) | k <- iota 0 t].
Proof.
rewrite /verify; case: ifP => // /graph_ok_sound good; case: ifP => // + _ l0.
rewrite /lower_part; case: eqnP => [l|_]; first by rewrite l in l0.
by rewrite /lower_ok; case: ifP => // rig _; apply: components_ok_sound.
Qed.
