//! All tests of the checker as a library, as one program.

mod changes;

mod affine;
mod at_cameras;
mod base_lines;
mod conditions;
mod contradictions;
mod displacements;
mod intrinsics;
mod parts;
mod solutions;
mod tampering;
