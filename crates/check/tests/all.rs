//! All tests of the checker as a library, as one program.

mod changes;

mod added;
mod affine;
mod base_lines;
mod conditions;
mod displacements;
mod here;
mod intrinsics;
mod overlap;
mod parts;
mod points;
mod solutions;
mod tampering;
