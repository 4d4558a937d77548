#version 330 core
// A vertex of an instance. Names of attributes, uniforms and the *_LOC defines are pyrender's interface.

layout(location = 0) in vec3 position;
#ifdef NORMAL_LOC
layout(location = NORMAL_LOC) in vec3 normal;
out vec3 frag_normal;
#endif
#ifdef TEXCOORD_0_LOC
layout(location = TEXCOORD_0_LOC) in vec2 texcoord_0;
out vec2 floor_position;
#endif
#ifdef TEXCOORD_1_LOC
layout(location = TEXCOORD_1_LOC) in vec2 texcoord_1;
out vec2 image_position;
#endif
layout(location = INST_M_LOC) in mat4 world_from_mesh;
layout(location = 12) in vec4 instance_color;

uniform mat4 V;
uniform mat4 P;
uniform vec3 cam_pos;
uniform float focus;  // distance from the camera to its target, m

out vec3 frag_position;
flat out vec4 frag_color;

void main()
{
#ifdef NORMAL_LOC
    vec4 world = world_from_mesh * vec4(position, 1.0);
    frag_position = world.xyz;
    frag_color = instance_color;
    frag_normal = mat3(world_from_mesh) * normal;  // poses are rigid
#ifdef TEXCOORD_0_LOC
    floor_position = texcoord_0;
#endif
#ifdef TEXCOORD_1_LOC
    image_position = texcoord_1;
#endif
    gl_Position = P * V * world;
#else
    // The sky fills the picture just before the far plane; the fragment needs the line of sight in the world. Parallel
    // light would all meet the sky at one point, so there it is as seen through a lens that shows as much at the target.
    vec3 sight = vec3(position.x / P[0][0], position.y / P[1][1], P[3][3] == 1.0 ? -focus : -1.0);
    frag_position = cam_pos + transpose(mat3(V)) * sight;
    frag_color = instance_color;
    gl_Position = vec4(position.xy, 0.999999, 1.0);
#endif
}
