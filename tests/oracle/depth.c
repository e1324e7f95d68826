#include "oracle/depth.h"

wide tl_oracle_depth_of_share(tl_depth_range of, wide share)
{
    const wide near = of.near, far = of.far;
    if (of.linear)
        return near + share * (far - near);
    return isinfq(far) ? near / (1 - share) : near * far / (far - share * (far - near));
}

wide tl_oracle_share_of_depth(tl_depth_range of, wide depth)
{
    const wide near = of.near, far = of.far;
    if (of.linear)
        return (depth - near) / (far - near);
    return isinfq(far) ? 1 - near / depth : far * (depth - near) / (depth * (far - near));
}

wide tl_oracle_ray(wide begin, wide end, wide count, wide index)
{
    return begin + (index + 0.5Q) * (end - begin) / count;
}
