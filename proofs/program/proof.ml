(* The reader of proofs (docs/proof.md). Nothing rests on it: whatever it makes of a file, the checker that is proved
   accepts it only if it is a proof. It looks up where nodes stand, and sorts. *)

exception Unreadable of string

type t = {
  lower : int;
  upper : int;
  bodies : Checker.body array;
  blocks : Checker.block array;
  half : int;  (** where the second list of blocks begins *)
  shared : Checker.body;
  place : int -> (int * (int -> int)) option;
}

module Table = Hashtbl.Make (struct
  type t = int

  let equal (a : int) b = a = b
  let hash (a : int) = Hashtbl.hash a
end)

let by_key count key =
  let order = Array.init count Fun.id in
  Array.stable_sort (fun (a : int) b -> compare (key a : int) (key b)) order;
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
    let value = int_of_string ("0u" ^ w) in
    if value > Graph.largest then fail "a number above 2^30";
    value
  in
  let finished () =
    while !at < String.length text && (text.[!at] = '\n' || text.[!at] = ' ') do incr at done;
    !at = String.length text
  in
  (word, number, finished, fail)

let read path (graph : Graph.t) =
  let word, number, finished, fail = words path in
  let expect w = if word () <> w then fail (w ^ " expected") in
  let n = graph.nodes and m = Array.length graph.first in
  expect "viewcert"; expect "proof";
  if number () <> 1 then fail "a proof of another version";
  expect "graph";
  let n' = number () in
  let m' = number () in
  if n' <> n || m' <> m then fail (Printf.sprintf "a proof for a graph with %d nodes and %d pairs" n' m');
  expect "claim";
  let lower = number () in
  let upper = number () in
  let pair_at = Table.create (2 * m) in
  for k = 0 to m - 1 do Table.replace pair_at ((graph.first.(k) * n) + graph.second.(k)) k done;
  let body_at = Table.create 1024 in
  let node () =
    let v = number () in
    if v >= n then fail "no such node";
    v
  in
  (* reason 0: a pair of the graph; c + 1: body c *)
  let reason count i j why =
    if why = 0 then
      match Table.find_opt pair_at ((min i j * n) + max i j) with
      | Some k -> Checker.Pair k
      | None -> fail (Printf.sprintf "%d %d is no pair" i j)
    else
      let c = why - 1 in
      match (Table.find_opt body_at ((c * n) + i), Table.find_opt body_at ((c * n) + j)) with
      | Some s, Some t when c < count -> Checker.Inside (c, s, t)
      | _ -> fail (Printf.sprintf "%d and %d are not both in body %d" i j c)
  in
  let body reason =
    let size = number () in
    let core_size = number () in
    let rows = number () in
    if size > n || core_size > size || rows > 1 lsl 24 then fail "sizes out of range";
    let nodes = Array.make size 0 and centres = Array.make core_size (0, 0, 0) in
    let joins = Array.make (size - core_size) [] in
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
    let order = by_key size (fun s -> nodes.(s)) in
    {
      Checker.body_size = size;
      node = (fun s -> nodes.(s));
      by_node = (fun s -> order.(s));
      core_size;
      core;
      centre = (fun s k -> let x, y, z = centres.(s) in match k with 0 -> x | 1 -> y | _ -> z);
      joins = (fun s -> joins.(s - core_size));
    }
  in
  let bodies = ref [] and count = ref 0 and blocks = ref [] and block_count = ref 0 and half = ref 0 in
  let block_at = Table.create 1024 in
  let blocks_of = Array.make n [] in
  let block () =
    let size = number () in
    if size > n then fail "sizes out of range";
    let nodes = Array.init size (fun _ -> node ()) in
    let b = !block_count in
    Array.iteri (fun s v -> Table.replace block_at ((b * n) + v) s; blocks_of.(v) <- b :: blocks_of.(v)) nodes;
    blocks := { Checker.block_size = size; block_node = (fun s -> nodes.(s)) } :: !blocks;
    incr block_count
  in
  (* one of some blocks that holds two nodes, and their positions in it *)
  let block_with suits i j =
    let short = if List.compare_lengths blocks_of.(i) blocks_of.(j) < 0 then blocks_of.(i) else blocks_of.(j) in
    let both b =
      match (Table.find_opt block_at ((b * n) + i), Table.find_opt block_at ((b * n) + j)) with
      | Some s, Some t when suits b -> Some (b, s, t)
      | _ -> None
    in
    List.find_map both short
  in
  let in_both i j why =
    match (block_with (fun b -> b < !half) i j, block_with (fun b -> b >= !half) i j) with
    | Some (b, s, t), Some (b', s', t') when why = 0 -> Checker.Both (b, s, t, b', s', t')
    | _ -> fail (Printf.sprintf "%d and %d are not both in a block and in one of the others" i j)
  in
  let shared = ref None in
  let rec others () =
    match word () with
    | "other" -> block (); others ()
    | "shared" -> shared := Some (body in_both); expect "end"
    | _ -> fail "other or shared expected"
  in
  let rec items () =
    match word () with
    | "body" ->
        let read = body (reason !count) in
        for s = 0 to read.Checker.body_size - 1 do Table.replace body_at ((!count * n) + read.node s) s done;
        bodies := read :: !bodies;
        incr count;
        items ()
    | "block" -> block (); half := !block_count; items ()
    | "other" -> block (); others ()
    | "end" -> ()
    | _ -> fail "body, block, other or end expected"
  in
  items ();
  if not (finished ()) then fail "something after the end";
  let place k =
    match block_with (fun _ -> true) graph.first.(k) graph.second.(k) with
    | Some (b, s, t) -> Some (b, fun end_ -> if end_ = 0 then s else t)
    | None -> None
  in
  let nothing =
    { Checker.body_size = 0; node = Fun.id; by_node = Fun.id; core_size = 0; core = []; centre = (fun _ _ -> 0);
      joins = (fun _ -> []) }
  in
  {
    lower;
    upper;
    bodies = Array.of_list (List.rev !bodies);
    blocks = Array.of_list (List.rev !blocks);
    half = !half;
    shared = Option.value !shared ~default:nothing;
    place;
  }
