#define HOST_CLIP_SPACE host_polygon2
#define DIMENSION 2
#define CELL_DIMENSION 2
#include "lib/clip/host_clip.inl"
