// A flanged bearing bracket (Gmsh 4.8, Debian's package gmsh):
//   gmsh -3 bracket.geo -format mesh -o bracket.tmp && sed "s/^ *//; s/  */ /g" bracket.tmp > bracket.mesh
// Lengths in millimetres. Only the tetrahedra are saved, in Medit's format.
SetFactory("OpenCASCADE");

Box(1) = {-40, -25, 0, 80, 50, 8};          // the base plate
Cylinder(2) = {0, 0, 0, 0, 0, 48, 18};      // the hub
Box(3) = {-36, -4, 0, 72, 8, 30};           // a rib to either side
Cylinder(4) = {0, 0, 34, 0, 30, 0, 9};      // a nozzle at the front
BooleanUnion(10) = { Volume{1}; Delete; }{ Volume{2, 3, 4}; Delete; };

Cylinder(20) = {0, 0, -1, 0, 0, 60, 11};    // the bore
Cylinder(21) = {0, 0, 34, 0, 40, 0, 5};     // through the nozzle into the bore
Cylinder(22) = {-32, -17, -1, 0, 0, 12, 4}; // four bolt holes
Cylinder(23) = {32, -17, -1, 0, 0, 12, 4};
Cylinder(24) = {-32, 17, -1, 0, 0, 12, 4};
Cylinder(25) = {32, 17, -1, 0, 0, 12, 4};
BooleanDifference(30) = { Volume{10}; Delete; }{ Volume{20:25}; Delete; };

// The upright edges of the plate are rounded.
corners[] = {};
For i In {0:3}
  x = (i % 2 == 0) ? -40 : 40;
  y = (i < 2) ? -25 : 25;
  corners[] += Curve In BoundingBox {x - .1, y - .1, -.1, x + .1, y + .1, 8.1};
EndFor
Fillet{30}{corners[]}{6}

Physical Volume("bracket") = {Volume{:}};
Mesh.MeshSizeMin = 2.2;
Mesh.MeshSizeMax = 3.4;
Mesh.MeshSizeFromCurvature = 14;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
General.NumThreads = 1;
