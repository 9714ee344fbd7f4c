(* SHA-256 (FIPS 180-4), for the name of the graph that is printed. Constants are computed: the first 32 bits of the
   fractional parts of the square and cube roots of primes. Right for ints of 32 bits as well, as a browser has them. *)

let mask = 0xffffffff

let primes =
  let is_prime n = List.for_all (fun d -> d * d > n || n mod d <> 0) (List.init 20 (fun d -> d + 2)) in
  Array.of_list (List.filteri (fun k _ -> k < 64) (List.filter is_prime (List.init 320 (fun n -> n + 2))))

let fraction x = int_of_float ((x -. floor x) *. 4294967296.)
let start = Array.map (fun p -> fraction (sqrt (float_of_int p))) (Array.sub primes 0 8)
let rounds = Array.map (fun p -> fraction (Float.cbrt (float_of_int p))) primes

let hex text =
  let length = String.length text in
  let padded = ((length + 8) / 64 * 64) + 64 in
  let byte k =
    if k < length then Char.code text.[k]
    else if k = length then 0x80
    else
      (* the number of bits, in bytes from the highest down *)
      match padded - 1 - k with
      | 0 -> length lsl 3 land 0xff
      | last when last <= 4 -> length lsr ((8 * last) - 3) land 0xff
      | _ -> 0
  in
  let turn x k = ((x lsr k) lor (x lsl (32 - k))) land mask in
  let h = Array.copy start and w = Array.make 64 0 in
  for block = 0 to (padded / 64) - 1 do
    for t = 0 to 15 do
      let at = (64 * block) + (4 * t) in
      w.(t) <- (byte at lsl 24) lor (byte (at + 1) lsl 16) lor (byte (at + 2) lsl 8) lor byte (at + 3)
    done;
    for t = 16 to 63 do
      let x = w.(t - 15) and y = w.(t - 2) in
      let s0 = turn x 7 lxor turn x 18 lxor (x lsr 3) and s1 = turn y 17 lxor turn y 19 lxor (y lsr 10) in
      w.(t) <- (w.(t - 16) + s0 + w.(t - 7) + s1) land mask
    done;
    let v = Array.copy h in
    for t = 0 to 63 do
      let a = v.(0) and e = v.(4) in
      let s1 = turn e 6 lxor turn e 11 lxor turn e 25 and choice = e land v.(5) lxor (lnot e land mask land v.(6)) in
      let one = (v.(7) + s1 + choice + rounds.(t) + w.(t)) land mask in
      let s0 = turn a 2 lxor turn a 13 lxor turn a 22 in
      let two = s0 + (a land v.(1) lxor (a land v.(2)) lxor (v.(1) land v.(2))) in
      Array.blit v 0 v 1 7;
      v.(4) <- (v.(4) + one) land mask;
      v.(0) <- (one + two) land mask
    done;
    Array.iteri (fun k x -> h.(k) <- (h.(k) + x) land mask) v
  done;
  String.concat "" (Array.to_list (Array.map (Printf.sprintf "%08x") h))
