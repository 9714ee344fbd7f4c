(* viewcert-proved GRAPH PROOF, or viewcert-proved --list FILE with a line "GRAPH PROOF" for each graph.

   Exit codes: 0 all verified, 1 a proof is rejected, 2 something is unreadable, 3 too large for this machine. *)

let say = Printf.printf

(* what verify_sound and its corollaries say of these numbers *)
let theorem model n lower upper solvable =
  let full = Checker.required model n in
  let matrix, cameras, form =
    match model with
    | Checker.Projective -> ("J", "cameras", "11 n - 15")
    | Calibrated -> ("N", "points in space", "3 n - 4")
    | Affine -> ("N", "points in a plane", "2 n - 3")
  in
  (match model with
   | Projective -> ()
   | Calibrated -> say "  calibrated model: directions of points in space\n"
   | Affine -> say "  affine model: directions of points in a plane\n");
  if lower = full then say "  the generic rank of %s is %d = %s: full rank\n" matrix full form
  else if lower = upper then say "  the generic rank of %s is %d\n" matrix lower
  else begin
    if lower > 0 then say "  some rational %s have rank %d at least\n" cameras lower;
    if upper < full then say "  for all %s over all fields of characteristic 0 the rank of %s is at most %d\n" cameras matrix upper
  end;
  if upper < full then say "  full rank would be %s = %d: not of full rank\n" form full;
  (* what calibrated_determined and affine_determined say *)
  if model <> Projective && lower = full then say "  directions determine generic %s, up to scale and translation\n" cameras;
  if model <> Projective && upper < full then say "  directions do not determine generic %s, up to scale and translation\n" cameras;
  (* what verify_solvable says *)
  if solvable then say "  solvable: fundamental matrices determine generic cameras, up to factors and one projectivity\n"
  else if lower = 0 && upper >= full then say "  nothing is claimed\n"

(* what verify_components says of these bodies *)
let components bodies =
  say "  the largest sets of two nodes or more whose pairs have full rank among themselves: %d\n" (Array.length bodies);
  Array.iter
    (fun body ->
      say "   ";
      for s = 0 to body.Checker.body_size - 1 do say " %d" (body.Checker.node s) done;
      say "\n")
    bodies

(* of bodies without a core nothing is asked *)
let no_scales = { Checker.centre_at = (fun _ _ -> 0); tree = (fun _ -> raise Not_found); steps = [] }

let check graph_path proof_path =
  let graph = Graph.read graph_path in
  let n = graph.nodes and m = Array.length graph.first in
  let first k = graph.first.(k) and second k = graph.second.(k) in
  let order = Proof.by_key m (fun k -> Natural.add (Natural.mul n (first k)) (second k)) in
  let by_pair k = order.(k) in
  if not (Checker.graph_ok n m first second by_pair) then
    raise (Graph.Unreadable (graph_path ^ ": not a simple graph with two nodes or more, smaller node of a pair first"));
  let proof = Proof.read proof_path graph in
  let last = max 0 (Array.length proof.bodies - 1) in
  let bound = proof.bound in
  let place k = bound.place [| first k; second k |] in
  let accepted =
    (proof.lower = 0 || Array.length proof.bodies > 0)
    && Checker.verify proof.model n m first second by_pair
         (fun b -> proof.bodies.(b)) proof.owner last proof.lower
         (fun c -> bound.blocks.(c)) bound.half bound.shared (Array.length bound.blocks) place proof.upper
    &&
    (not proof.solvable
    ||
    let count = Array.length proof.bodies in
    let all = Array.append proof.bodies (Array.map fst proof.uniques) in
    let scales b = if b < count then no_scales else snd proof.uniques.(b - count) in
    Array.length all > 0 && Checker.solvable_ok n m first second (fun b -> all.(b)) proof.sure scales (Array.length all - 1))
    &&
    match proof.components with
    | None -> true
    | Some c ->
        proof.lower > 0
        && Checker.components_ok proof.model n m first second
             (fun b -> proof.bodies.(b)) last proof.owner c.in_owner (Array.length c.numbers)
             (fun k -> c.numbers.(k)) c.pair_at c.steps
  in
  say "%s: %d nodes, %d pairs, SHA-256 of the file %s: %s\n" (String.escaped graph_path) n m graph.sha256
    (if accepted then "VERIFIED" else "REJECTED: the proof does not show its claim");
  if accepted then begin
    theorem proof.model n proof.lower proof.upper proof.solvable;
    Option.iter (fun c -> components (Array.map (fun b -> proof.bodies.(b)) c.Proof.numbers)) proof.components
  end;
  if accepted then 0 else 1

let guarded graph proof =
  let unreadable why = flush stdout; prerr_endline ("viewcert-proved: " ^ why); 2 in
  let too_large () = flush stdout; prerr_endline ("viewcert-proved: " ^ proof ^ ": too large for this machine"); 3 in
  try check graph proof with
  | Graph.Unreadable why | Proof.Unreadable why | Sys_error why -> unreadable why
  | Invalid_argument _ | Not_found | Division_by_zero | Failure _ -> unreadable (proof ^ ": out of range")
  | Out_of_memory | Stack_overflow -> too_large ()

let list_of path =
  let line text =
    match String.split_on_char ' ' text with
    | [ graph; proof ] -> (graph, proof)
    | _ -> raise (Graph.Unreadable (path ^ ": a line with a graph and a proof expected"))
  in
  let text = Graph.contents path in
  List.map line (List.filter (( <> ) "") (String.split_on_char '\n' text))

let () =
  let pairs =
    match Array.to_list Sys.argv with
    | [ _; "--list"; path ] -> (
        try list_of path with Graph.Unreadable why | Sys_error why -> prerr_endline ("viewcert-proved: " ^ why); exit 2)
    | [ _; graph; proof ] -> [ (graph, proof) ]
    | _ -> prerr_endline "usage: viewcert-proved GRAPH PROOF, or viewcert-proved --list FILE"; exit 2
  in
  if pairs = [] then (prerr_endline "viewcert-proved: an empty list"; exit 2);
  say "Statements are about the matrices J and N of proofs/theories/Statement.v. A graph is finite solvable iff J has full rank:\n\
       that is Theorem 1.3 of docs/theory.md, which is cited and not proved here. Solvable is as Statement.v defines it.\n\
       Directions, of N, are those of calibrated cameras whose rotations are known. That a graph is affine solvable iff they\n\
       determine points in a plane is Theorem 13.2, which is cited.\n";
  exit (List.fold_left (fun worst (graph, proof) -> max worst (guarded graph proof)) 0 pairs)
