#define HOST_CLIP_SPACE host_polygon3
#define DIMENSION 3
#define CELL_DIMENSION 2
#include "lib/clip/host_clip.inl"
