#define HOST_CLIP_SPACE host_polyhedron
#define DIMENSION 3
#define CELL_DIMENSION 3
#include "lib/clip/host_clip.inl"
