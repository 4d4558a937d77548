#version 330 core
// A vertex of an instance, with the instance's id in place of a colour.

layout(location = 0) in vec3 position;
layout(location = INST_M_LOC) in mat4 world_from_mesh;
layout(location = 13) in vec4 instance_id;  // its bytes, lowest first, over 255

uniform mat4 V;
uniform mat4 P;

flat out vec4 id;

void main()
{
    id = instance_id;
    gl_Position = P * V * world_from_mesh * vec4(position, 1.0);
}
