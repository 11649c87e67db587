/* Clips pairs as diagram/clip_pairs.cl does, with moments of a density besides. A program of its own, so that
   diagrams without a density do not pay for it in registers. */
#define WITH_DENSITY 1
#include "device_diagram/clip_pairs.cl"
