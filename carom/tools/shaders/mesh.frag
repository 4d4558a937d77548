#version 330 core
// Light: a sun with soft shadows, a hemisphere of sky and ground, and their reflection in smooth surfaces.
// A mesh without normals is the sky itself; one with first texture coordinates is a floor of squares that ends in haze,
// and one with second ones has an image on it.

in vec3 frag_position;
flat in vec4 frag_color;
out vec4 color;

uniform vec3 cam_pos;
uniform vec3 up;
uniform float focus;  // distance from the camera to its target, m

vec3 sky(vec3 direction)
{
    float height = dot(direction, up);
    vec3 haze = vec3(0.66, 0.71, 0.77);
    vec3 zenith = vec3(0.13, 0.22, 0.38);
    vec3 ground = vec3(0.20, 0.20, 0.21);
    return height > 0.0 ? mix(haze, zenith, smoothstep(0.0, 0.75, height)) : mix(haze, ground, smoothstep(0.0, 0.9, -height));
}

// Colours are mixed linear and shown with gamma 2, which is near sRGB and costs a square root.
vec3 shown(vec3 linear) { return sqrt(min(linear, 1.0)); }

#ifdef NORMAL_LOC
in vec3 frag_normal;
#ifdef TEXCOORD_0_LOC
in vec2 floor_position;
uniform float square;  // edge of a square, m

// Returns the share of dark squares under the pixel, integrated over it, so that far squares turn even.
float dark(vec2 at)
{
    vec2 width = fwidth(at) + 0.001;
    vec2 part = 2.0 * (abs(fract((at - 0.5 * width) * 0.5) - 0.5) - abs(fract((at + 0.5 * width) * 0.5) - 0.5)) / width;
    return 0.5 - 0.5 * part.x * part.y;
}
#endif

#ifdef USE_METALLIC_MATERIAL
#ifdef TEXCOORD_1_LOC
in vec2 image_position;
struct Material { float roughness_factor; float metallic_factor; sampler2D base_color_texture; };
#else
struct Material { float roughness_factor; };
#endif
uniform Material material;
#endif
uniform vec3 sun;  // direction towards it
#ifdef DIRECTIONAL_LIGHT_SHADOWS
uniform mat4 light_matrix;
uniform float texel;  // edge of a texel of the shadow map, m
uniform float blur;  // by which shadows are softened, in parts of the shadow map
uniform sampler2DShadow shadow_map;

// Returns the share of the sun that arrives here, from four filtered comparisons.
float sunlit(vec3 at)
{
    vec3 place = (light_matrix * vec4(at, 1.0)).xyz * 0.5 + 0.5;
    vec3 border = vec3(2.0 * blur, 2.0 * blur, 0.0);  // beyond it the filter would reach over the edge of the map
    if (any(lessThan(place, border)) || any(greaterThan(place, 1.0 - border))) return 1.0;
    return 0.25 * (texture(shadow_map, place + vec3(-blur, -0.4 * blur, 0.0))
                 + texture(shadow_map, place + vec3(0.4 * blur, -blur, 0.0))
                 + texture(shadow_map, place + vec3(blur, 0.4 * blur, 0.0))
                 + texture(shadow_map, place + vec3(-0.4 * blur, blur, 0.0)));
}
#else
float sunlit(vec3 at) { return 1.0; }
const float texel = 0.0;
#endif
#endif

void main()
{
    vec3 ray = frag_position - cam_pos;
    float distance = length(ray);
    vec3 view = ray / distance;
#ifdef NORMAL_LOC
    vec3 albedo = frag_color.rgb * frag_color.rgb;
#ifdef TEXCOORD_0_LOC
    albedo *= 1.0 - 0.22 * dark(floor_position / square);
#endif
    float alpha = frag_color.a;
    vec3 normal = normalize(frag_normal);
#ifdef TEXCOORD_1_LOC
    vec4 image = texture(material.base_color_texture, image_position);
    albedo *= image.rgb * image.rgb;
    alpha *= image.a;
    if (!gl_FrontFacing) normal = -normal;
#endif
    float facing = dot(normal, sun);
    // Lifted by as much as the surface rises within the filter, no face lies in its own shadow, however slanted.
    float lift = texel * (0.25 + 2.75 * sqrt(1.0 - min(facing * facing, 1.0)));
    float sunshine = facing > 0.0 ? facing * sunlit(frag_position + normal * lift) : 0.0;
    vec3 ambient = mix(vec3(0.14, 0.13, 0.12), vec3(0.34, 0.38, 0.45), 0.5 + 0.5 * dot(normal, up));
    vec3 light = albedo * (ambient + vec3(1.12, 1.04, 0.92) * sunshine);

    // Other materials reflect nothing.
#ifdef USE_METALLIC_MATERIAL
    float gloss = 1.0 - material.roughness_factor;
    vec3 mirrored = reflect(view, normal);
    float grazing = 1.0 - max(-dot(normal, view), 0.0);
    float grazing_squared = grazing * grazing;
    float mirror = gloss * (0.03 + 0.35 * grazing_squared * grazing_squared * grazing);
    light = mix(light, sky(mirrored), mirror);
#ifdef TEXCOORD_1_LOC
    light = mix(light, albedo * sky(mirrored), gloss * material.metallic_factor);
#endif
    float glint = max(dot(mirrored, sun), 0.0);
    light += gloss * step(0.001, sunshine) * (0.9 * pow(glint, 220.0) + 0.12 * pow(glint, 24.0));
#endif
#ifdef TEXCOORD_0_LOC
    light = mix(light, sky(view), smoothstep(3.0, 14.0, distance / focus));
#endif
    color = vec4(shown(light), alpha);
#else
    color = vec4(shown(sky(view)), 1.0);
#endif
}
