/* Compiled by clang to LLVM's form, never linked: CountFlops.cmake counts the operations of each
 * function. So the figure follows the formulas, whoever changes them.
 *
 * The frame of the bench's scenes: a Phong material, linear falloff, a perspective camera. */
#include "light.h"
#include "planes.h"

void flops_of_test(const surface *s, const tl_view_light *light, int *out);
void flops_of_pair(const surface *s, const tl_view_light *light, received *sum);

static const tl_needs needs = {.present = TL_GROUP_BASE | TL_GROUP_PHONG,
                               .falloffs = 1u << TL_FADE_LINEAR,
                               .specular = 1,
                               .models = 1u << TL_MODEL_PHONG};

/* What a pair costs whose light does not reach. */
void flops_of_test(const surface *s, const tl_view_light *light, int *out)
{
    const vec3 l = vector_to_light(s->position, *light);
    *out = reaches(*light, dot3(l, l));
}

/* What it costs, test included, where the light does. */
void flops_of_pair(const surface *s, const tl_view_light *light, received *sum)
{
    const finish none = {0};
    *sum = add_ranged_light(*sum, needs, *s, none, *light, whole_space());
}
