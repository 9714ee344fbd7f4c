(* The program as OCaml. Numbers become OCaml's ints: right as long as none reaches 2^62, which the readers see to (no
   number above 2^30 comes in; the largest product is n first + second < 2^60). *)
From Coq Require Import Extraction ExtrOcamlBasic ExtrOcamlNatInt.
From mathcomp Require Import all_ssreflect.
From Viewcert Require Import Statement Differential Generic Counting Rigid Directions Parallel Models Components Elimination Bearing Flows Hub Cores Checker Separation Generically Unique Scales Solvable Sanity.

Extract Inlined Constant muln => "Natural.mul".
Extract Inlined Constant addn => "Natural.add".
Extract Inlined Constant subn => "Natural.sub".
Extract Inlined Constant leq => "Natural.leq".
Extract Inlined Constant eqn => "Natural.eq".
Extract Inlined Constant modn => "Natural.modulo".
Extract Inlined Constant divn => "Natural.div".
Extraction "checker.ml" graph_ok verify solvable_ok components_ok cells allows required.

Print Assumptions verify_sound.
Print Assumptions verify_components.
Print Assumptions verify_solvable.
Print Assumptions exact_rank.
Print Assumptions has_full_rank.
Print Assumptions lacks_full_rank.
Print Assumptions lemma_1_1.
Print Assumptions lemma_1_2.
Print Assumptions differential.
Print Assumptions kernel_of_map.
Print Assumptions proposition_1_4.
Print Assumptions lemma_3_4.
Print Assumptions calibrated_determined.
Print Assumptions affine_determined.
Print Assumptions full_rank_unique.
Print Assumptions less_rank_many.
Print Assumptions full_rank_rays.
Print Assumptions less_rank_rays.
Print Assumptions bearing_rank_sound.
Print Assumptions rule_4.
Print Assumptions lemma_3_1.
Print Assumptions corollary_3_3.
Print Assumptions theorem_4_1.
Print Assumptions rule_1.
Print Assumptions rule_3.
Print Assumptions rule_5.
Print Assumptions settled.
Print Assumptions demandsP.
Print Assumptions demands_generic.
Print Assumptions corollary_4_2.
Print Assumptions generic_cameras.
Print Assumptions rank_generically.
Print Assumptions theorem_5_1.
Print Assumptions theorem_5_2.
Print Assumptions theorem_5_9.
Print Assumptions corollary_5_11.
Print Assumptions separation.
Print Assumptions components_are.
Print Assumptions epipolar.
Print Assumptions derivative.
Print Assumptions edges_all.
Print Assumptions one_rank.
Print Assumptions largest.
Print Assumptions a_rank.
Print Assumptions rational_cameras.
Print Assumptions renamed.
Print Assumptions only_trivial_motions.
Print Assumptions full_rank_component.
Print Assumptions one_pair_has_rank_7.
Print Assumptions pair.
Print Assumptions triangle.
Print Assumptions triangle_solvable.
Print Assumptions no_pair_unsolvable.
Print Assumptions four_cycle.
Print Assumptions N_kernel.
Print Assumptions parallel.
Print Assumptions triangle_determined.
Print Assumptions five_cycle_undetermined.
Print Assumptions four_cycle_undetermined.
Print Assumptions no_pair_undetermined.
