(* Natural numbers as the proved program computes with them, in OCaml's ints: right as long as none reaches 2^62. *)

let[@inline] add (a : int) b = a + b
let[@inline] mul (a : int) b = a * b
let[@inline] sub (a : int) b = if a < b then 0 else a - b
let[@inline] leq (a : int) b = a <= b
let[@inline] eq (a : int) b = a = b
let[@inline] modulo (a : int) b = if b = 0 then a else a mod b
let[@inline] div (a : int) b = if b = 0 then 0 else a / b
