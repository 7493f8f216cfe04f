// What each lobe scatters towards a direction, for kernels that sort light by how it was scattered.
#ifndef HIPR_MATERIAL_LOBE_SHARES_GLSL
#define HIPR_MATERIAL_LOBE_SHARES_GLSL

struct LobeShares {
    vec3 diffuse, sheen, specular, coat;
    bool through;  // to the other side of the surface: there are diffuse and specular lobes alone
};
#endif
