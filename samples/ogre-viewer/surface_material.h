// The look of the surface: smooth, matt, lit per pixel by two lights.
#pragma once

/// Makes the material `name`. It shows both sides, for surfaces may have boundaries.
void create_surface_material(const char* name);
