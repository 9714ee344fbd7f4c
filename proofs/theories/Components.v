(* Section 6: which parts of a graph are finite solvable, and that there are no larger ones.

   Parts of full rank are told apart by two facts. A part whose pairs are of two kinds has two nodes at least that have
   pairs of both kinds. And if x and y are nodes of two components that one part meets in a pair each, the pair (x, y)
   does not raise the rank, wherever else it is known not to be larger. *)
From mathcomp Require Import all_ssreflect all_algebra zify.
From Viewcert Require Import Statement Counting Rigid Models.
Set Implicit Arguments. Unset Strict Implicit. Unset Printing Implicit Defensive.

Section Parts.
Variables (M : model) (n : nat) (E : seq ('I_n * 'I_n)).
Hypothesis loopfree : forall e, e \in E -> e.1 != e.2.
Implicit Types (b c d : seq 'I_n) (e f : 'I_n * 'I_n).

Definition induced b : seq ('I_n * 'I_n) := [seq e <- E | inside b e].
Definition rigid_part b := [/\ 1 < size b, uniq b & attained M (induced b) (required M (size b))].

(* x is an end of a pair in b of this kind *)
Definition touches b (kind : pred ('I_n * 'I_n)) (x : 'I_n) : bool :=
  has (fun e => [&& inside b e, kind e & (e.1 == x) || (e.2 == x)]) E.

Theorem two_kinds b (p1 p2 : pred ('I_n * 'I_n)) : rigid_part b ->
  (forall e, e \in E -> inside b e -> p1 e || p2 e) ->
  has (fun e => inside b e && p1 e) E -> has (fun e => inside b e && p2 e) E ->
  exists x y, [/\ x != y, touches b p1 x && touches b p2 x & touches b p1 y && touches b p2 y].
Proof.
case=> sb ub full kinds h1 h2; pose A p := [seq x <- b | touches b p x].
have inA (p : pred ('I_n * 'I_n)) e : e \in E -> inside b e -> p e -> inside (A p) e.
  move=> eE be pe; have /andP [b1 b2] := be; rewrite /inside !mem_filter b1 b2 !andbT.
  by apply/andP; split; apply/hasP; exists e; rewrite // be pe eqxx ?orbT.
have size_A (p : pred ('I_n * 'I_n)) : has (fun e => inside b e && p e) E -> 1 < size (A p).
  case/hasP=> e eE /andP [be pe]; have /andP [i1 i2] := inA p e eE be pe.
  apply: (@uniq_leq_size _ [:: e.1; e.2]) => [|x]; first by rewrite /= inE loopfree.
  by rewrite !inE => /orP [/eqP ->|/eqP ->].
have bound : at_most M (induced b) (required M (size (A p1)) + required M (size (A p2))).
  pose E' p := [seq e <- induced b | inside (A p) e].
  apply: (@at_most_mono _ _ _ (E' p1 ++ E' p2)) => [e eb|].
    have /andP [be eE] : inside b e && (e \in E) by rewrite -mem_filter.
    rewrite mem_cat; case/orP: (kinds e eE be) => pe; apply/orP; [left | right]; rewrite mem_filter eb andbT; exact: inA.
  by apply: at_most_cat; apply: at_most_inside (filter_all _ _); exact: size_A.
pose D := [seq x <- b | touches b p1 x && touches b p2 x].
have sizes : size (A p1) + size (A p2) <= size D + size b.
  rewrite !size_filter -count_predUI addnC leq_add2l; exact: count_size.
have D2 : 1 < size D := two_shared (size_A p1 h1) (size_A p2 h2) (at_most_attained bound full) sizes.
have uD : uniq D by apply: filter_uniq.
case e: D D2 uD => [|x [|y s]] // _ /andP [xy _]; exists x, y.
have xD : x \in D by rewrite e mem_head.
have yD : y \in D by rewrite e !inE eqxx orbT.
by move: xD yD xy; rewrite !mem_filter inE negb_or => /andP [-> _] /andP [-> _] /andP [-> _].
Qed.

(* ------------------------------------------------------------------ unions of parts *)
Definition all_pairs b : seq ('I_n * 'I_n) := [seq (x, y) | x <- b, y <- b].
Lemma all_pairsE b e : (e \in all_pairs b) = inside b e.
Proof. by case: e => x y; apply/allpairsP/andP => [[[x' y'] [? ? [-> ->]]]|[? ?]] //; exists (x, y). Qed.

(* each node of w is joined to the ends of e *)
Fixpoint joins w e : seq ('I_n * 'I_n) := if w is x :: w' then (x, e.1) :: (x, e.2) :: joins w' e else [::].

Lemma joins_sub w e d : {subset w <= d} -> inside d e -> {subset joins w e <= all_pairs d}.
Proof.
move=> wd /andP [d1 d2]; elim: w wd => //= x w ih wd f.
have xd : x \in d by apply: wd; apply: mem_head.
rewrite !inE => /or3P [/eqP -> | /eqP -> |]; try by rewrite all_pairsE /inside xd ?d1 ?d2.
by apply: ih => z zw; apply: wd; rewrite inE zw orbT.
Qed.

Lemma attained_joins b w e S s : e.1 != e.2 -> inside b e -> uniq w -> all (fun x => x \notin b) w ->
  all (inside b) S -> attained M S s -> attained M (joins w e ++ S) (s + two M * size w).
Proof.
move=> e12 /andP [b1 b2] + + Sb a; elim: w => [|x w ih] /=; first by rewrite muln0 addn0.
case/andP=> xw uw /andP [xb wb]; rewrite mulnS addnCA addnC; apply: grow_two (ih uw wb) => //.
- by apply: contraNneq xb => ->.
- by apply: contraNneq xb => ->.
apply/allP=> f; rewrite mem_cat => /orP [|/(allP Sb) /andP [f1 f2]]; last first.
  by apply/andP; split; apply: contraNneq xb => <-.
move=> fw; have /andP [] : inside (w ++ b) f.
  rewrite -all_pairsE; apply: joins_sub fw => [z zw|]; first by rewrite mem_cat zw.
  by rewrite /inside !mem_cat b1 b2 !orbT.
rewrite !mem_cat => /orP f1 /orP f2.
have nx z : z \in w \/ z \in b -> z != x by case=> zx; [apply: contraNneq xw => <- | apply: contraNneq xb => <-].
by rewrite !nx.
Qed.

(* D: pairs of the graph, those of the part b and of the components c, d among them *)
Theorem together (D : seq ('I_n * 'I_n)) r b c d e f x y :
  rigid_part b -> rigid_part c -> rigid_part d ->
  {subset induced b <= D} -> {subset induced c <= D} -> {subset induced d <= D} ->
  at_most M D r ->
  e \in E -> inside b e -> inside c e -> f \in E -> inside b f -> inside d f -> x \in c -> y \in d ->
  ~ attained M ((x, y) :: D) r.+1.
Proof.
move=> rb rc rd bD cD dD le eE be ce fE bf df xc yd up.
have drop g X s : rigid_part g -> {subset induced g <= X} -> attained M (all_pairs g ++ X) s -> attained M X s.
  case=> sg _ fullg gX; apply: (full (T := induced g) (b := g)) => //.
  - by apply/allP=> h /gX hX; rewrite /either hX.
  - exact: filter_all.
  - by apply/allP=> h; rewrite all_pairsE.
suff : attained M D r.+1 by move/(at_most_attained le); rewrite ltnn.
apply: (drop d) => //; apply: (drop c) => //; first by move=> g /cD gD; rewrite mem_cat gD orbT.
apply: (drop b) => //; first by move=> g /bD gD; rewrite !mem_cat gD !orbT.
set D' := all_pairs b ++ _.
have D'b g : inside b g -> g \in D' by rewrite /D' mem_cat all_pairsE => ->.
have D'c g : inside c g -> g \in D' by rewrite /D' !mem_cat !all_pairsE => ->; rewrite orbT.
have D'd g : inside d g -> g \in D' by rewrite /D' !mem_cat !all_pairsE => ->; rewrite !orbT.
have upD : attained M ((x, y) :: D') r.+1.
  apply: attained_mono up => g; rewrite !inE => /orP [->|gD] //; apply/orP; right.
  by rewrite /D' !mem_cat gD !orbT.
case: rb => sb ub fullb; clear bD cD dD up drop; clearbody D'.
pose w1 := [seq z <- undup c | z \notin b]; pose b1 := w1 ++ b.
pose w2 := [seq z <- undup d | z \notin b1]; pose u := w2 ++ b1.
have full1 : attained M (joins w1 e ++ all_pairs b) (required M (size b) + two M * size w1).
  apply: (attained_joins (b := b)); rewrite ?loopfree ?filter_uniq ?undup_uniq ?filter_all //.
    by apply/allP=> g; rewrite all_pairsE.
  by apply: attained_mono fullb => g; rewrite mem_filter all_pairsE => /andP [].
have b1f : inside b1 f by case/andP: bf => f1 f2; rewrite /inside !mem_cat f1 f2 !orbT.
have w1c : {subset w1 <= c} by move=> z; rewrite mem_filter mem_undup => /andP [].
have w2d : {subset w2 <= d} by move=> z; rewrite mem_filter mem_undup => /andP [].
have in1 : all (inside b1) (joins w1 e ++ all_pairs b).
  apply/allP=> g; rewrite mem_cat => /orP [|]; last first.
    by rewrite all_pairsE => /andP [g1 g2]; rewrite /inside !mem_cat g1 g2 !orbT.
  rewrite -all_pairsE; apply: joins_sub; first by move=> z zw; rewrite mem_cat zw.
  by case/andP: be => e1 e2; rewrite /inside !mem_cat e1 e2 !orbT.
have full2 := attained_joins (loopfree fE) b1f _ _ in1 full1.
have {full2} full2 : attained M (joins w2 f ++ joins w1 e ++ all_pairs b) (required M (size u)).
  have -> : required M (size u) = required M (size b) + two M * size w1 + two M * size w2.
    by rewrite !size_cat required_more.
  by apply: full2; rewrite ?filter_uniq ?undup_uniq ?filter_all.
apply: (full (T := joins w2 f ++ joins w1 e ++ all_pairs b) (K := [:: (x, y)]) (b := u)) full2 upD.
- by rewrite !size_cat; do 2!apply: ltn_addl.
- apply/allP=> g gT; apply/orP; left; move: gT; rewrite !mem_cat => /or3P [/(joins_sub w2d df) | /(joins_sub w1c ce) |];
    rewrite all_pairsE; [exact: D'd | exact: D'c | exact: D'b].
- apply/allP=> g; rewrite mem_cat => /orP [|/(allP in1) /andP [g1 g2]]; last first.
    by rewrite /inside !mem_cat; move: g1 g2; rewrite !mem_cat => -> ->; rewrite !orbT.
  rewrite -all_pairsE; apply: joins_sub; first by move=> z zw; rewrite mem_cat zw.
  by case/andP: b1f => f1 f2; rewrite /inside ![_ \in u]mem_cat f1 f2 !orbT.
- rewrite /= andbT; apply/andP; split; rewrite mem_cat.
    by rewrite orbC mem_cat mem_filter mem_undup xc andbT; case: (x \in b).
  by rewrite mem_filter mem_undup yd andbT; case: (y \in b1).
Qed.

(* ------------------------------------------------------------------ candidates, and telling them apart *)
Section Candidates.
Variables (t : nat) (comp : nat -> seq 'I_n).
Hypothesis comp_rigid : forall k, k < t -> rigid_part (comp k).
Hypothesis comp_cover : forall e, e \in E -> exists2 k, k < t & inside (comp k) e.
Implicit Types q : pred nat.

(* the pair e lies in a candidate of this kind; b and candidate k have a pair in common *)
Definition kind q e : bool := has (fun k => q k && inside (comp k) e) (iota 0 t).
Definition meets b k : bool := has (fun e => inside b e && inside (comp k) e) E.

(* a part that meets some of these candidates meets no others *)
Definition closed q : Prop := forall b k l, rigid_part b -> k < t -> l < t -> q k -> ~~ q l -> meets b k -> meets b l -> False.

Lemma kindP q e : reflect (exists k, [/\ k < t, q k & inside (comp k) e]) (kind q e).
Proof.
apply: (iffP hasP) => [[k] | [k [kt qk ke]]]; first by rewrite mem_iota => /= kt /andP [qk ke]; exists k.
by exists k; rewrite ?mem_iota // qk.
Qed.

Lemma touchesP b q x : reflect (exists k e, [/\ [/\ k < t & q k], e \in E, inside b e, inside (comp k) e & x \in [:: e.1; e.2]])
  (touches b (kind q) x).
Proof.
apply: (iffP hasP) => [[e eE /and3P [be /kindP [k [kt qk ke]] xe]] | [k [e [[kt qk] eE be ke xe]]]].
  by exists k, e; split=> //; rewrite !inE ![x == _]eq_sym.
exists e => //; rewrite be /=; apply/andP; split; first by apply/kindP; exists k.
by move: xe; rewrite !inE ![x == _]eq_sym.
Qed.

Lemma all_closed : closed (fun k => k < t).
Proof. by move=> b k l _ _ -> _. Qed.

Lemma closed_part q q' : closed q -> (forall k, q' k -> q k) ->
  (forall b, rigid_part b -> (forall e, e \in E -> inside b e -> kind q e) -> forall x y, x != y ->
    touches b (kind q') x -> touches b (kind q') y ->
    touches b (kind (fun k => q k && ~~ q' k)) x -> touches b (kind (fun k => q k && ~~ q' k)) y -> False) ->
  closed q'.
Proof.
move=> cq sub two b k l rb kt lt qk ql bk bl; have qqk := sub k qk.
case: (boolP (q l)) => [qql | nql]; last exact: cq rb kt lt qqk nql bk bl.
have kinds e : e \in E -> inside b e -> kind q e.
  move=> eE be; have [j jt je] := comp_cover eE; apply/kindP; exists j; split=> //; apply/negPn/negP=> nqj.
  by apply: (cq b k j rb kt jt qqk nqj bk); apply/hasP; exists e; rewrite // be.
have [||| x [y [xy /andP [x1 x2] /andP [y1 y2]]]] := two_kinds (p1 := kind q') (p2 := kind (fun k => q k && ~~ q' k)) rb.
- move=> e eE be; have /kindP [j [jt qj je]] := kinds e eE be.
  case: (boolP (q' j)) => q'j; apply/orP; [left | right]; apply/kindP; exists j; split=> //; exact/andP.
- by case/hasP: bk => e eE /andP [be ke]; apply/hasP; exists e; rewrite // be; apply/kindP; exists k.
- case/hasP: bl => e eE /andP [be le]; apply/hasP; exists e; rewrite // be; apply/kindP; exists l; split=> //; exact/andP.
exact: two b rb kinds x y xy x1 y1 x2 y2.
Qed.

Lemma touched_node b q x : touches b (kind q) x -> exists k, [/\ k < t, q k & x \in comp k].
Proof.
case/touchesP=> k [e [[kt qk] _ _ /andP [k1 k2]]]; rewrite !inE => xe.
by exists k; split=> //; case/orP: xe => /eqP ->.
Qed.

(* Theorem 4.3 (b): pieces *)
Theorem cut q q' w : closed q -> (forall k, q' k -> q k) ->
  (forall k l v, k < t -> l < t -> q' k -> q l -> ~~ q' l -> v \in comp k -> v \in comp l -> v = w) -> closed q'.
Proof.
move=> cq sub one; apply: (closed_part cq sub) => b _ _ x y xy.
case/touched_node=> k [kt qk xk] /touched_node [k' [kt' qk' yk']] /touched_node [l [lt /andP [ql nl] xl]].
case/touched_node=> l' [lt' /andP [ql' nl'] yl'].
by move: xy; rewrite (one k l x) // (one k' l' y) // eqxx.
Qed.

(* Theorem 6.4, without the lifting: candidates that share a node are told apart by some pair that raises the rank *)
Definition pairs_of_kind q := [seq e <- E | kind q e].
Theorem separated q q' r : closed q -> (forall k, q' k -> q k) ->
  at_most M (pairs_of_kind q) r ->
  (forall k l v, k < t -> l < t -> q' k -> q l -> ~~ q' l -> v \in comp k -> v \in comp l ->
    exists x y, [/\ x \in comp k, y \in comp l & attained M ((x, y) :: pairs_of_kind q) r.+1]) -> closed q'.
Proof.
move=> cq sub le sep; apply: (closed_part cq sub) => b rb kinds x x2 _.
case/touchesP=> k [e [[kt qk] eE be ke xe]] _ /touchesP [l [f [[lt /andP [ql nl]] fE bf lf xf]]] _.
have end_in g (c : seq 'I_n) : inside c g -> x \in [:: g.1; g.2] -> x \in c.
  by case/andP=> g1 g2; rewrite !inE => /orP [/eqP ->|/eqP ->].
have [y [z [yk zl]]] := sep k l x kt lt qk ql nl (end_in e _ ke xe) (end_in f _ lf xf).
have in_kind j : j < t -> q j -> {subset induced (comp j) <= pairs_of_kind q}.
  by move=> jt qj g; rewrite !mem_filter => /andP [jg ->]; rewrite andbT; apply/kindP; exists j.
apply: (together rb (comp_rigid kt) (comp_rigid lt)) eE be ke fE bf lf yk zl => //.
- by move=> g; rewrite !mem_filter => /andP [bg gE]; rewrite gE andbT kinds.
- exact: in_kind kt (sub k qk).
- exact: in_kind lt ql.
Qed.

(* all candidates told apart: they are the largest parts *)
Hypothesis apart : forall k, k < t -> closed (pred1 k).

Lemma pair_in b : rigid_part b -> exists2 e, e \in E & inside b e.
Proof.
case=> sb _; case e: (induced b) => [|f s].
  by move/(at_most_attained (at_most_nil _ _)); rewrite leqNgt required_positive.
have : f \in induced b by rewrite e mem_head.
by rewrite mem_filter => /andP [bf fE] _; exists f.
Qed.

Theorem largest b : rigid_part b -> exists2 k, k < t & {subset b <= comp k}.
Proof.
move=> rb; have [e eE be] := pair_in rb; have [k kt ke] := comp_cover eE; exists k => //.
have allk f : f \in E -> inside b f -> inside (comp k) f.
  move=> fE bf; have [l lt lf] := comp_cover fE; case: (l =P k) => [<- //|/eqP nlk].
  by case: (apart kt rb kt lt (eqxx k) nlk); apply/hasP; [exists e | exists f]; rewrite // ?be ?bf.
have [sb ub fullb] := rb; set b' := [seq x <- b | x \in comp k].
have inb' : all (inside b') (induced b).
  apply/allP=> f; rewrite mem_filter => /andP [bf fE]; have /andP [f1 f2] := allk f fE bf.
  by case/andP: bf => b1 b2; rewrite /inside !mem_filter f1 f2 b1 b2.
have sb' : 1 < size b'.
  have /andP [e1 e2] : inside b' e by apply: (allP inb'); rewrite mem_filter be.
  apply: (@uniq_leq_size _ [:: e.1; e.2]) => [|x]; first by rewrite /= inE loopfree.
  by rewrite !inE => /orP [/eqP ->|/eqP ->].
have le' : size b <= size b' := required_mono sb sb' (at_most_attained (at_most_inside M sb' inb') fullb).
suff : all (fun x => x \in comp k) b by move/allP.
by rewrite all_count eqn_leq count_size -size_filter.
Qed.

Theorem antichain k l : k < t -> l < t -> {subset comp k <= comp l} -> k = l.
Proof.
move=> kt lt sub; apply/eqP/negPn/negP; rewrite eq_sym => nlk.
have rk := comp_rigid kt; have [e eE ke] := pair_in rk.
have le : inside (comp l) e by case/andP: ke => /sub k1 /sub k2; apply/andP.
by apply: (apart kt rk kt lt (eqxx k) nlk); apply/hasP; exists e; rewrite // ke.
Qed.
End Candidates.
End Parts.

(* ------------------------------------------------------------------ in the words of Statement.v *)
Lemma rigid_partP M n G (b : seq 'I_n) : part M n G (map val b) <-> rigid_part M (edges n G) b.
Proof.
have same : edges n (within (map val b) G) =i induced (edges n G) b.
  by move=> e; rewrite mem_filter !edgesE mem_filter /inside /= !(mem_map val_inj).
rewrite /part size_map (map_inj_uniq val_inj); split.
  by case=> sb ub _ a; split=> //; apply: (@attained_mono M _ _ _ _ _ a) => e; rewrite same.
case=> sb ub a; split=> //; first by apply/allP=> _ /mapP [v _ ->]; exact: ltn_ord.
by apply: (@attained_mono M _ _ _ _ _ a) => e; rewrite same.
Qed.

Lemma as_nodes n (b : seq nat) : all (fun v => v < n) b -> exists b' : seq 'I_n, map val b' = b.
Proof.
elim: b => [|x b ih] /=; first by exists [::].
by case/andP=> xn /ih [b' <-]; exists (Ordinal xn :: b').
Qed.

Theorem components_are M n G t (comp : nat -> seq 'I_n) : well_formed n G ->
  (forall k, k < t -> rigid_part M (edges n G) (comp k)) ->
  (forall e, e \in edges n G -> exists2 k, k < t & inside (comp k) e) ->
  (forall k, k < t -> closed M (edges n G) t comp (pred1 k)) ->
  components M n G [seq map val (comp k) | k <- iota 0 t].
Proof.
case/and3P=> _ /allP lt _ rig cov apart.
have loopfree (e : 'I_n * 'I_n) : e \in edges n G -> e.1 != e.2.
  by rewrite edgesE => /lt /andP [/= e12 _]; rewrite -val_eqE neq_ltn e12.
have part_in b : part M n G b -> exists2 k, k < t & {subset b <= map val (comp k)}.
  move=> pb; have [_ _ /as_nodes [b' eb] _] := pb; move: pb; rewrite -eb => /rigid_partP.
  case/(largest loopfree cov apart) => k kt sub; exists k => // _ /mapP [x /sub xk ->]; exact: map_f.
have comp_component k : k < t -> component M n G (map val (comp k)).
  move=> kt; split=> [|b pb sub]; first by apply/rigid_partP/rig.
  have [l lt' bl] := part_in b pb; suff -> : k = l by [].
  apply: (antichain rig apart) => // x xk; rewrite -(mem_map val_inj); apply/bl/sub; exact: map_f.
split=> [_ /mapP [k + ->] | b [pb maxb]]; first by rewrite mem_iota => /comp_component.
have [k kt sub] := part_in b pb; exists (map val (comp k)).
  by apply/mapP; exists k; rewrite ?mem_iota.
have [pk _] := comp_component k kt.
by move=> x; apply/idP/idP=> [/(maxb _ pk sub)|/sub].
Qed.
