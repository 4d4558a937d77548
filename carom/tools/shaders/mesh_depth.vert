#version 330 core
// A vertex as the sun sees it, for the shadow map. The sky and endless floors cast no shadow.

layout(location = 0) in vec3 position;
layout(location = INST_M_LOC) in mat4 world_from_mesh;

uniform mat4 V;
uniform mat4 P;

void main()
{
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0);  // outside of all that is drawn
#ifdef NORMAL_LOC
#ifndef TEXCOORD_0_LOC
    gl_Position = P * V * world_from_mesh * vec4(position, 1.0);
#endif
#endif
}
