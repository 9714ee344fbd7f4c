(* The reader of proofs (docs/proof.md). Nothing rests on it: whatever it makes of a file, the checker that is proved
   accepts it only if it is a proof. It looks up where nodes stand, and sorts. *)

exception Unreadable of string

(* an upper bound: blocks, where the second list of them begins, what the two lists share *)
type bound = {
  blocks : Checker.block array;
  half : int;
  shared : Checker.body;
  place : int array -> ((int * int) * (int -> int)) option;  (** a cell of a block that holds some nodes, and where *)
}

type components = {
  numbers : int array;  (** of the bodies that are components *)
  in_owner : int -> int -> int;
  pair_at : int -> (int * int) * int;
  steps : Checker.step list;
}

type t = {
  model : Checker.model;
  lower : int;
  upper : int;
  bodies : Checker.body array;
  owner : int -> int;
  bound : bound;
  components : components option;
  sure : int -> bool;  (** which bodies are uniquely determined *)
  uniques : (Checker.body * Checker.scales) array;  (** sets that are uniquely determined, and their scales *)
  solvable : bool;
}

module Table = Hashtbl.Make (struct
  type t = int

  let equal (a : int) b = a = b
  let hash (a : int) = Hashtbl.hash a
end)

let by_key count key =
  let order = Array.init count Fun.id in
  let by_natural a b =
    let x : int = key a and y = key b in
    if x = y then 0 else if Natural.leq x y then -1 else 1
  in
  Array.stable_sort by_natural order;
  order

(* words separated by blanks and line feeds *)
let words path =
  let text = Graph.contents path in
  let at = ref 0 and line = ref 1 in
  let fail why = raise (Unreadable (Printf.sprintf "%s:%d: %s" path !line why)) in
  let rec word () =
    if !at >= String.length text then fail "ends early";
    match text.[!at] with
    | '\n' -> incr line; incr at; word ()
    | ' ' -> incr at; word ()
    | _ ->
        let from = !at in
        while !at < String.length text && text.[!at] <> ' ' && text.[!at] <> '\n' do incr at done;
        String.sub text from (!at - from)
  in
  let number () =
    let w = word () in
    if String.length w > 10 || not (String.for_all (fun c -> c >= '0' && c <= '9') w) then fail ("not a number: " ^ String.escaped (String.sub w 0 (min 20 (String.length w))));
    (* as text: in a browser ten digits may be more than an int holds *)
    if String.length w = 10 && w > string_of_int Graph.largest then fail "a number above 2^30";
    int_of_string w
  in
  (* whether this word comes next, which is passed by then *)
  let passed w =
    let before = (!at, !line) in
    let next = try word () with Unreadable _ -> "" in
    next = w || (at := fst before; line := snd before; false)
  in
  let finished () =
    while !at < String.length text && (text.[!at] = '\n' || text.[!at] = ' ') do incr at done;
    !at = String.length text
  in
  (word, passed, number, finished, fail)

(* what is read of nodes, bodies and blocks, whatever they are for *)
type reader = {
  word : unit -> string;
  passed : string -> bool;
  number : unit -> int;
  node : unit -> int;
  fail : 'a. string -> 'a;
  nodes : int;
  model : Checker.model;
}

(* entries of the motion of a node *)
let width = function Checker.Projective -> 12 | Calibrated -> 3 | Affine -> 2

let projective reader word = if reader.model <> Checker.Projective then reader.fail (word ^ " in the projective model only")

let key reader k v = Natural.add (Natural.mul k reader.nodes) v

(* nodes behind a core, each joined to two before it at most *)
let joined { word; node; number; fail; _ } reason position add core_size size =
  let joins = Array.make (size - core_size) [] in
  for s = core_size to size - 1 do
    let kind = word () in
    let v = node () in
    let join () =
      let a = node () in
      let why = number () in
      (position a, reason v a why)
    in
    joins.(s - core_size) <-
      (match kind with
      | "free" -> []
      | "one" -> [ join () ]
      | "two" ->
          let first = join () in
          [ first; join () ]
      | _ -> fail "free, one or two expected");
    add s v
  done;
  joins

let body ({ passed; number; node; fail; nodes = n; _ } as reader) reason =
  let size = number () in
  let core_size = number () in
  let rows = number () in
  if size > n || core_size > size || rows > 1 lsl 24 then fail "sizes out of range";
  let nodes = Array.make size 0 and centres = Array.make core_size (0, 0, 0) in
  let here = Table.create (2 * size) in
  let position v = match Table.find_opt here v with Some s -> s | None -> fail "a node that is not in the body yet" in
  let add s v = nodes.(s) <- v; Table.replace here v s in
  for s = 0 to core_size - 1 do
    add s (node ());
    let x = number () in
    let y = number () in
    let z = number () in
    centres.(s) <- (x, y, z)
  done;
  let row _ =
    let i = node () in
    let j = node () in
    let mask = number () in
    let why = number () in
    (((position i, position j), mask), reason i j why)
  in
  let core = List.init rows row in
  let weights _ =
    let first = number () in
    (first, number ())
  in
  let flow _ = List.init rows weights in
  let flows =
    if not (passed "flows") then []
    else
      let () = projective reader "flows" in
      let count = number () in
      if rows = 0 || count > 1 lsl 24 then fail "sizes out of range" else List.init count flow
  in
  let joins = joined reader reason position add core_size size in
  let order = by_key size (fun s -> nodes.(s)) in
  {
    Checker.body_size = size;
    node = (fun s -> nodes.(s));
    by_node = (fun s -> order.(s));
    core_size;
    core;
    centre = (fun s k -> let x, y, z = centres.(s) in match k with 0 -> x | 1 -> y | _ -> z);
    flows;
    joins = (fun s -> joins.(s - core_size));
  }

let nothing =
  { Checker.body_size = 0; node = Fun.id; by_node = Fun.id; core_size = 0; core = []; centre = (fun _ _ -> 0);
    flows = []; joins = (fun _ -> []) }

(* a set that is uniquely determined, and why the scales of its core are one *)
let unique ({ word; number; node; fail; nodes = n; _ } as reader) reason =
  let size = number () in
  let core_size = number () in
  let middle = number () in
  let count = number () in
  if size > n || core_size > size || middle > n || count > 1 lsl 24 then fail "sizes out of range";
  let nodes = Array.make size 0 and centres = Table.create 64 and here = Table.create (2 * size) in
  let position v = match Table.find_opt here v with Some s -> s | None -> fail "a node that is not in the set yet" in
  let add s v = nodes.(s) <- v; Table.replace here v s in
  let centre () =
    let v = node () in
    let x = number () in
    let y = number () in
    let z = number () in
    Table.replace centres v (x, y, z);
    v
  in
  for s = 0 to core_size - 1 do add s (centre ()) done;
  for _ = 1 to middle do ignore (centre ()) done;
  let link () =
    let kind = word () in
    let i = node () in
    let j = node () in
    let k = number () in
    let why = number () in
    let by_ =
      match kind with
      | "pair" -> Checker.Direct (k, reason i j why)
      | "middle" ->
          if not (Table.mem centres k) then fail "a node without centre";
          let first = reason i k why in
          Checker.Middle (k, first, reason k j (number ()))
      | _ -> fail "pair or middle expected"
    in
    { Checker.from = position i; to0 = position j; by_ }
  in
  let tree = Array.init (max 0 (core_size - 1)) (fun _ -> link ()) in
  let step _ =
    match word () with
    | "settle" ->
        let links = number () in
        if links < 1 || links > 4 then fail "one to four links expected";
        let first = link () in
        Checker.Settle (first, List.init (links - 1) (fun _ -> link ()))
    | "corner" ->
        let i = node () in
        let j = node () in
        let k = node () in
        Checker.Corner (position i, position j, position k, reason i k (number ()))
    | _ -> fail "settle or corner expected"
  in
  let steps = List.init count step in
  let joins = joined reader reason position add core_size size in
  let order = by_key size (fun s -> nodes.(s)) in
  ( { nothing with Checker.body_size = size; node = (fun s -> nodes.(s)); by_node = (fun s -> order.(s)); core_size;
      joins = (fun s -> joins.(s - core_size)) },
    { Checker.centre_at = (fun v k -> match Table.find_opt centres v with Some (x, y, z) -> (match k with 0 -> x | 1 -> y | _ -> z) | None -> 0);
      tree = (fun s -> tree.(s - 1)); steps } )

(* A block of so many nodes, the first of which is a hub: cells, and how the nodes of the split graph hang together *)
let split { number; fail; _ } size =
  let copies = number () in
  let count = number () in
  if copies > 1 lsl 24 || count > 1 lsl 24 then fail "sizes out of range";
  let all = size + copies in
  let position () =
    let x = number () in
    if x >= all then fail "no such node of the split graph";
    x
  in
  let cell _ =
    let members = number () in
    if members > all then fail "sizes out of range";
    Array.init members (fun _ -> position ())
  in
  let cells = Array.init count cell in
  if copies > Array.fold_left (fun sum members -> sum + Array.length members) 0 cells then fail "a copy that is in no cell";
  let meeting = Array.make all [] in
  Array.iteri (fun d -> Array.iteri (fun i x -> meeting.(x) <- (d, i) :: meeting.(x))) cells;
  let link = Array.make all None and depth = Array.make all (-1) and seen = Array.make count false in
  let near = Queue.create () in
  let reach x from = if depth.(x) < 0 then begin depth.(x) <- from; Queue.add x near end in
  let spread x =
    let through (d, j) =
      if not seen.(d) then begin
        seen.(d) <- true;
        Array.iteri (fun i y -> if depth.(y) < 0 then begin link.(y) <- Some ((d, i), j); reach y (depth.(x) + 1) end) cells.(d)
      end
    in
    List.iter through meeting.(x)
  in
  for x = 0 to all - 1 do
    reach x 0;
    while not (Queue.is_empty near) do spread (Queue.pop near) done
  done;
  ( cells,
    {
      Checker.copies;
      cell_count = count;
      cell_size = (fun d -> Array.length cells.(d));
      cell_node = (fun d i -> cells.(d).(i));
      link = (fun x -> link.(x));
      depth = (fun x -> depth.(x));
    } )

(* blocks, other blocks and what they share, from the word [first] on; and the word that comes next *)
let bound reader first =
  let { word; passed; number; node; fail; nodes = n } = reader in
  let blocks = ref [] and count = ref 0 and half = ref 0 and shared = ref nothing in
  (* cells are numbered through all blocks *)
  let at = Table.create 1024 and of_node = Table.create 1024 and block_of = Table.create 1024 in
  let around v = Option.value (Table.find_opt of_node v) ~default:[] in
  let cell d nodes =
    let c = Table.length block_of in
    Table.replace block_of c (!count, d);
    Array.iteri (fun s v -> Table.replace at (key reader c v) s; Table.replace of_node v (c :: around v)) nodes
  in
  let block () =
    let size = number () in
    if size > n then fail "sizes out of range";
    let nodes = Array.init size (fun _ -> node ()) in
    let hub =
      if not (passed "hub") then begin cell 0 nodes; None end
      else
        let () = projective reader "hub" in
        let cells, split = split reader size in
        let home x = nodes.(if x < size then x else 0) in
        if size > 0 then Array.iteri (fun d members -> cell d (Array.map home members)) cells;
        Some split
    in
    blocks := { Checker.block_size = size; block_node = (fun s -> nodes.(s)); hub } :: !blocks;
    incr count
  in
  let cell_with suits nodes =
    let shorter list v = if List.compare_lengths (around v) list < 0 then around v else list in
    let holds c v = Table.mem at (key reader c v) in
    let candidates = Array.fold_left shorter (around nodes.(0)) nodes in
    List.find_opt (fun c -> suits (fst (Table.find block_of c)) && Array.for_all (holds c) nodes) candidates
  in
  let position c v = Table.find at (key reader c v) in
  let in_both i j why =
    match (cell_with (fun b -> b < !half) [| i; j |], cell_with (fun b -> b >= !half) [| i; j |]) with
    | Some c, Some c' when why = 0 ->
        let b, d = Table.find block_of c and b', d' = Table.find block_of c' in
        Checker.Both (b, d, position c i, position c j, b', d', position c' i, position c' j)
    | _ -> fail (Printf.sprintf "%d and %d are not both in a block and in one of the others" i j)
  in
  let rec others = function
    | "other" -> block (); others (word ())
    | "shared" -> shared := body reader in_both; word ()
    | _ -> fail "other or shared expected"
  in
  let rec all = function
    | "block" -> block (); half := !count; all (word ())
    | "other" as first -> others first
    | next -> next
  in
  let next = all first in
  let where nodes c = (Table.find block_of c, fun s -> position c nodes.(s)) in
  let place nodes = Option.map (where nodes) (cell_with (fun _ -> true) nodes) in
  ({ blocks = Array.of_list (List.rev !blocks); half = !half; shared = !shared; place }, next)

(* a step that tells the components lo .. hi-1 apart; [nodes] are those of a component *)
let cut lo hi ends nodes =
  let home = Table.create 64 and attached = Table.create 64 in
  let of_interval lo hi =
    for k = lo to hi - 1 do
      let see v =
        match Table.find_opt home v with
        | None -> Table.replace home v lo
        | Some first -> if first < lo then Table.replace attached lo v
      in
      Array.iter see (nodes k)
    done;
    hi
  in
  ignore (List.fold_left of_interval lo ends);
  Checker.Cut (ends, { Checker.home = Table.find home; attached = Table.find_opt attached })

let apart reader lo hi ends nodes =
  let { number; fail; word; _ } = reader in
  let at = Table.create 64 in
  for k = lo to hi - 1 do Array.iteri (fun s v -> Table.replace at (key reader k v) s) (nodes k) done;
  let reason i j why =
    let k = why - 1 in
    let found v = if k < lo || k >= hi then None else Table.find_opt at (key reader k v) in
    match (found i, found j) with
    | Some s, Some t -> Checker.Inside (k, s, t)
    | _ -> fail (Printf.sprintf "%d and %d are not both in the component" i j)
  in
  let frame = body reader reason in
  let motion = Array.init (width reader.model * frame.core_size) (fun _ -> number ()) in
  let bound, next = bound reader (word ()) in
  let position = Table.create 64 in
  for q = 0 to frame.body_size - 1 do Table.replace position (frame.node q) q done;
  let there = Array.make frame.body_size [||] in
  let place = Array.init (hi - lo) (fun k -> Array.make (Array.length (nodes (lo + k))) 0) in
  let meeting = Array.make frame.body_size [] and count = Array.make frame.body_size 0 in
  for k = lo to hi - 1 do
    let see s v =
      match Table.find_opt position v with
      | None -> fail (Printf.sprintf "%d is in a component and not in the body that tells it apart" v)
      | Some q ->
          place.(k - lo).(s) <- count.(q);
          count.(q) <- count.(q) + 1;
          meeting.(q) <- k :: meeting.(q)
    in
    Array.iteri see (nodes k)
  done;
  Array.iteri (fun q list -> there.(q) <- Array.of_list (List.rev list)) meeting;
  let interval = Array.make (hi - lo) lo in
  let mark first last =
    if last <= first || last > hi then fail "intervals out of range";
    for k = first to last - 1 do interval.(k - lo) <- first done;
    last
  in
  ignore (List.fold_left mark lo ends);
  (* positions of a component's core nodes, in the core and in it *)
  let core_of k =
    let nodes = nodes k and core = ref [] in
    for s = Array.length nodes - 1 downto 0 do
      let q = Table.find position nodes.(s) in
      if q < frame.core_size then core := (q, s) :: !core
    done;
    !core
  in
  let tells (i, _) (j, _) =
    not (Checker.allows reader.model frame.centre (fun c -> motion.(c)) i j)
  in
  let cores = Array.init (hi - lo) (fun k -> core_of (lo + k)) in
  let witness c d =
    let first (i, s) =
      Option.map (fun (j, t) -> (((i, s), j), t)) (List.find_opt (fun y -> fst y <> i && tells (i, s) y) cores.(d - lo))
    in
    Option.value (List.find_map first cores.(c - lo)) ~default:(((0, 0), 0), 0)
  in
  ( Checker.Apart
      ( ends,
        {
          Checker.frame;
          motion = (fun c -> motion.(c));
          interval = (fun k -> interval.(k - lo));
          position = (fun k s -> Table.find position (nodes k).(s));
          place_there = (fun k s -> place.(k - lo).(s));
          meeting = (fun q -> Array.length there.(q));
          there = (fun q i -> there.(q).(i));
          witness;
          blocks_ = (fun b -> bound.blocks.(b));
          block_count = Array.length bound.blocks;
          half_ = bound.half;
          shared_ = bound.shared;
          in_ = (fun k -> bound.place (nodes (lo + k)));
        } ),
    next )

(* the steps, up to the word "end" *)
let steps reader count nodes =
  let { number; word; fail; _ } = reader in
  let ends () =
    let size = number () in
    if size > count then fail "sizes out of range";
    List.init size (fun _ -> number ())
  in
  let rec go word_ intervals done_ =
    match (word_, intervals) with
    | "end", _ -> List.rev done_
    | "cut", (lo, hi) :: rest ->
        let ends = ends () in
        if List.exists (fun x -> x > hi) ends then fail "intervals out of range";
        go (word ()) (Checker.cells lo ends rest) (cut lo hi ends nodes :: done_)
    | "apart", (lo, hi) :: rest ->
        let ends = ends () in
        let step, next = apart reader lo hi ends nodes in
        go next (Checker.cells lo ends rest) (step :: done_)
    | _ -> fail "cut, apart or end expected, and no more than it takes"
  in
  go (word ()) (Checker.cells 0 [ count ] []) []

(* For every body the component that it is part of: itself, or that of the body that uses it. *)
let owners bodies numbers =
  let owner = Array.make (Array.length bodies) (-1) in
  Array.iter (fun b -> owner.(b) <- b) numbers;
  for b = Array.length bodies - 2 downto 0 do
    if owner.(b) < 0 then owner.(b) <- b;
    let use = function Checker.Inside (c, _, _) -> if owner.(c) < 0 then owner.(c) <- owner.(b) | _ -> () in
    List.iter (fun (_, why) -> use why) bodies.(b).Checker.core;
    for s = bodies.(b).core_size to bodies.(b).body_size - 1 do
      List.iter (fun (_, why) -> use why) (bodies.(b).joins s)
    done
  done;
  owner

(* Bodies without a core that are made by the rules from pairs and such bodies *)
let determined bodies =
  let sure = Array.make (Array.length bodies) false in
  let good b body =
    let number = function Checker.Pair _ -> true | Checker.Inside (c, _, _) -> c < b && sure.(c) | _ -> false in
    let joined s = List.length (body.Checker.joins s) = min s 2 && List.for_all (fun (_, why) -> number why) (body.joins s) in
    let rec all s = s >= body.body_size || (joined s && all (s + 1)) in
    body.core_size = 0 && all 0
  in
  Array.iteri (fun b body -> sure.(b) <- good b body) bodies;
  sure

let components reader (graph : Graph.t) bodies body_at =
  let count = reader.number () in
  if count > Array.length bodies then reader.fail "sizes out of range";
  let number _ =
    let b = reader.number () in
    if b >= Array.length bodies then reader.fail "no such body";
    b
  in
  let numbers = Array.init count number in
  let nodes_of b = Array.init bodies.(b).Checker.body_size bodies.(b).node in
  let nodes = Array.map nodes_of numbers in
  let around = Table.create 1024 in
  let of_node v = Option.value (Table.find_opt around v) ~default:[] in
  Array.iteri (fun k -> Array.iter (fun v -> Table.replace around v (k :: of_node v))) nodes;
  let position k v = Table.find_opt body_at (key reader numbers.(k) v) in
  let pair_at e =
    let i = graph.first.(e) and j = graph.second.(e) in
    let short = if List.compare_lengths (of_node i) (of_node j) < 0 then of_node i else of_node j in
    let both k = match (position k i, position k j) with Some s, Some t -> Some ((k, s), t) | _ -> None in
    match List.find_map both short with
    | Some found -> found
    | None -> reader.fail (Printf.sprintf "%d %d is in no component" i j)
  in
  let owner = owners bodies numbers in
  let in_owner b s = if owner.(b) < 0 then raise Not_found else Table.find body_at (key reader owner.(b) (bodies.(b).Checker.node s)) in
  (owner, { numbers; in_owner; pair_at; steps = steps reader count (fun k -> nodes.(k)) })

let read path (graph : Graph.t) =
  let word, passed, number, finished, fail = words path in
  let expect w = if word () <> w then fail (w ^ " expected") in
  let n = graph.nodes and m = Array.length graph.first in
  expect "viewcert"; expect "proof";
  if number () <> 1 then fail "a proof of another version";
  expect "graph";
  let n' = number () in
  let m' = number () in
  let model =
    if not (passed "model") then Checker.Projective
    else match word () with
      | "calibrated" -> Calibrated
      | "affine" -> Affine
      | _ -> fail "calibrated or affine expected"
  in
  if n' <> n || m' <> m then fail (Printf.sprintf "a proof for a graph with %d nodes and %d pairs" n' m');
  expect "claim";
  let lower = number () in
  let upper = number () in
  let node () =
    let v = number () in
    if v >= n then fail "no such node";
    v
  in
  let reader = { word; passed; number; node; fail; nodes = n; model } in
  let pair_number = Table.create (2 * m) in
  for k = 0 to m - 1 do Table.replace pair_number (key reader graph.first.(k) graph.second.(k)) k done;
  let body_at = Table.create 1024 in
  (* reason 0: a pair of the graph; c + 1: body c *)
  let reason count i j why =
    if why = 0 then
      match Table.find_opt pair_number (key reader (min i j) (max i j)) with
      | Some k -> Checker.Pair k
      | None -> fail (Printf.sprintf "%d %d is no pair" i j)
    else
      let c = why - 1 in
      let found v = if c < count then Table.find_opt body_at (key reader c v) else None in
      match (found i, found j) with
      | Some s, Some t -> Checker.Inside (c, s, t)
      | _ -> fail (Printf.sprintf "%d and %d are not both in body %d" i j c)
  in
  let count = ref 0 in
  let number_it body =
    for s = 0 to body.Checker.body_size - 1 do Table.replace body_at (key reader !count (body.Checker.node s)) s done;
    incr count
  in
  let rec all kind read done_ next =
    if next <> kind then (Array.of_list (List.rev done_), next)
    else begin
      let one, body = read () in
      number_it body;
      all kind read (one :: done_) (word ())
    end
  in
  let read_body () = let body = body reader (reason !count) in (body, body) in
  let read_unique () = let one = unique reader (reason !count) in (one, fst one) in
  let bodies, next = all "body" read_body [] (word ()) in
  let bound, next = bound reader next in
  let uniques, next = all "unique" read_unique [] next in
  let solvable = next = "solvable" in
  if solvable || Array.length uniques > 0 then projective reader "solvable";
  if Array.length uniques > 0 && not solvable then fail "solvable expected";
  let components =
    match next with
    | "solvable" -> expect "end"; None
    | "end" -> None
    | "components" -> Some (components reader graph bodies body_at)
    | _ -> fail "body, block, other, unique, solvable, components or end expected"
  in
  if not (finished ()) then fail "something after the end";
  let owner, components =
    match components with
    | None -> ((fun _ -> 0), None)
    | Some (owner, components) -> ((fun b -> owner.(b)), Some components)
  in
  let sure = if solvable then Array.append (determined bodies) (Array.make (Array.length uniques) true) else [||] in
  { model; lower; upper; bodies; owner; bound; components; sure = (fun b -> sure.(b)); uniques; solvable }
