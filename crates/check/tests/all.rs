//! All tests of the checker as a library, as one program.

mod changes;

mod affine;
mod base_lines;
mod conditions;
mod displacements;
mod here;
mod intrinsics;
mod parts;
mod solutions;
mod tampering;
