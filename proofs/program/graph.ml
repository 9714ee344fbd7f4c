(* The reader of graphs: this file is trusted, the reader of proofs is not.

   One pair of nodes "i j" on each line, or one node "i" that has no pair, or a comment, which begins with "#". Nodes are
   the numbers 0 .. n-1; each of them occurs. Numbers are decimal without leading zeros, at most 2^30; one blank
   separates, a line feed ends each line. *)

exception Unreadable of string

type t = { nodes : int; first : int array; second : int array; sha256 : string }

let largest = 1 lsl 30

let contents path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let read path =
  let text = contents path in
  let line = ref 1 and first = ref [] and second = ref [] and seen = ref [] in
  let fail why = raise (Unreadable (Printf.sprintf "%s:%d: %s" path !line why)) in
  (* the number that begins at [at], and where it ends *)
  let number at =
    let rec go at value digits =
      match if at < String.length text then text.[at] else '\n' with
      | '0' .. '9' as c ->
          let digit = Char.code c - Char.code '0' in
          if value > (largest - digit) / 10 then fail "a number above 2^30";
          let value = (10 * value) + digit in
          if digits > 0 && value < 10 then fail "a leading zero";
          go (at + 1) value (digits + 1)
      | _ -> if digits = 0 then fail "a node number expected" else (value, at)
    in
    go at 0 0
  in
  let rec lines at =
    if at < String.length text && text.[at] = '#' then begin
      incr line;
      match String.index_from_opt text at '\n' with
      | Some last -> lines (last + 1)
      | None -> fail "end of line expected"
    end
    else if at < String.length text then begin
      let i, at = number at in
      seen := i :: !seen;
      let at =
        if at < String.length text && text.[at] = ' ' then begin
          let j, at = number (at + 1) in
          seen := j :: !seen;
          first := i :: !first;
          second := j :: !second;
          at
        end
        else at
      in
      if at >= String.length text || text.[at] <> '\n' then fail "end of line expected";
      incr line;
      lines (at + 1)
    end
  in
  lines 0;
  let nodes = 1 + List.fold_left max (-1) !seen in
  if nodes > List.length !seen then raise (Unreadable (path ^ ": some node numbers do not occur"));
  let occurs = Array.make nodes false in
  List.iter (fun v -> occurs.(v) <- true) !seen;
  if not (Array.for_all Fun.id occurs) then raise (Unreadable (path ^ ": some node numbers do not occur"));
  let array list = Array.of_list (List.rev list) in
  { nodes; first = array !first; second = array !second; sha256 = Sha256.hex text }
