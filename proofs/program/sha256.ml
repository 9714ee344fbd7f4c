(* SHA-256 (FIPS 180-4), for the name of the graph that is printed. Constants are computed: the first 32 bits of the
   fractional parts of the square and cube roots of primes. *)

let mask = 0xffffffff

(* the largest x with x^k <= n 2^(32 k), modulo 2^32, by its bits from the highest down; x is below 2^36 *)
let root k n =
  let rec power x k = if k = 0 then [ 1 ] else times (power x (k - 1)) x
  (* a number by digits of 16 bits, the lowest first, times x *)
  and times digits x =
    let rec go carry = function
      | [] -> if carry = 0 then [] else (carry land 0xffff) :: go (carry lsr 16) []
      | d :: rest ->
          let s = (d * x) + carry in
          (s land 0xffff) :: go (s lsr 16) rest
    in
    go 0 digits
  in
  let rec shifted words digits = if words = 0 then digits else 0 :: shifted (words - 1) digits in
  let rec trim = function 0 :: rest -> trim rest | digits -> digits in
  let at_most a b =
    let a = trim (List.rev a) and b = trim (List.rev b) in
    match List.compare_lengths a b with 0 -> compare a b <= 0 | c -> c < 0
  in
  let bound = shifted (2 * k) [ n ] in
  let rec bits x bit =
    if bit < 0 then x land mask
    else
      let more = x lor (1 lsl bit) in
      bits (if at_most (power more k) bound then more else x) (bit - 1)
  in
  bits 0 36

let primes =
  let is_prime n = List.for_all (fun d -> d * d > n || n mod d <> 0) (List.init 20 (fun d -> d + 2)) in
  Array.of_list (List.filteri (fun k _ -> k < 64) (List.filter is_prime (List.init 320 (fun n -> n + 2))))

let start = lazy (Array.map (root 2) (Array.sub primes 0 8))
let rounds = lazy (Array.map (root 3) primes)

let hex text =
  let length = String.length text in
  let padded = ((length + 8) / 64 * 64) + 64 in
  let byte k =
    if k < length then Char.code text.[k]
    else if k = length then 0x80
    else if k >= padded - 8 then (length * 8) lsr (8 * (padded - 1 - k)) land 0xff
    else 0
  in
  let turn x k = ((x lsr k) lor (x lsl (32 - k))) land mask in
  let h = Array.copy (Lazy.force start) and rounds = Lazy.force rounds and w = Array.make 64 0 in
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
