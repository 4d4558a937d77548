#version 330 core
// The id of the instance in red, green and blue.

flat in vec4 id;
out vec4 color;

void main()
{
    color = vec4(id.rgb, 1.0);
}
