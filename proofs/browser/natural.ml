(* The same in a browser, where an int has 32 bits: numbers below 2^32, those from 2^31 on as negative ints. A sum or
   product that is not below 2^32 ends the program ("too large for this machine"): that of n first + second does from
   65,536 nodes on. Floats hold all integers below 2^53. *)

let of_int a = if a < 0 then float_of_int a +. 4294967296. else float_of_int a
let below x = if x >= 4294967296. then raise Out_of_memory
let add a b = below (of_int a +. of_int b); a + b
let mul a b = below (of_int a *. of_int b); a * b
let leq a b = if a >= 0 && b >= 0 then a <= b else of_int a <= of_int b
let sub a b = if leq a b then 0 else a - b
let eq (a : int) b = a = b
let modulo a b = if b = 0 then a else if a >= 0 && b > 0 then a mod b else int_of_float (Float.rem (of_int a) (of_int b))
let div a b = if b = 0 then 0 else if a >= 0 && b > 0 then a / b else int_of_float (floor (of_int a /. of_int b))
