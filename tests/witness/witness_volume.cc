/* OpenVDB (K. Museth: VDB: High-resolution sparse volumes with dynamic topology, 2013) as the witness of volumes. In: a
 * cloud of spheres that OpenVDB makes (the signed distance, its fog) and rays all about it. Proves that lom reads such
 * voxels at the same places with the same weights: the optical depth of the reference against a fine sum over OpenVDB's
 * own samples, within the spans that its own walk through the tree finds. Only make check-long builds this. */
#include <lom/reference.h>

#include "check.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Composite.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetSphere.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/RayIntersector.h>

#include <cmath>

namespace
{

using openvdb::FloatGrid;
using openvdb::Vec3d;

constexpr int SIZE = 64, RAYS = 400, STEPS = 64; /* steps: of a voxel */
constexpr double EXTINCTION = 0.35;

/* Metres are voxels: world (x, y, z) is the centre of voxel (x, y, z). */
FloatGrid::Ptr make_cloud()
{
    const double middles[][4] = { { 32, 28, 32, 14 }, { 22, 30, 30, 9 }, { 42, 33, 36, 10.5 }, { 34, 44, 31, 7 } };
    FloatGrid::Ptr cloud;
    for (const auto &m : middles) {
        auto ball = openvdb::tools::createLevelSetSphere<FloatGrid>(
            float(m[3]), openvdb::Vec3f(Vec3d(m[0], m[1], m[2])), 1.0f, 5.0f);
        if (cloud)
            openvdb::tools::csgUnion(*cloud, *ball);
        else
            cloud = ball;
    }
    openvdb::tools::sdfToFogVolume(*cloud);
    return cloud;
}

lom_reference_volume *copy_to_lom(const FloatGrid &cloud)
{
    lom_error error = {};
    lom_image *image = lom_create_image(SIZE, SIZE, SIZE, LOM_FORMAT_R32F, &error);
    auto voxels = cloud.getConstAccessor();
    for (int z = 0; z < SIZE; z++)
        for (int y = 0; y < SIZE; y++)
            for (int x = 0; x < SIZE; x++)
                *static_cast<float *>(lom_image_pixel(image, x, y, z)) = voxels.getValue(openvdb::Coord(x, y, z));
    lom_reference_volume_desc desc = {};
    desc.density = image;
    desc.low = { -0.5, -0.5, -0.5 };
    desc.high = { SIZE - 0.5, SIZE - 0.5, SIZE - 0.5 };
    desc.extinction = EXTINCTION;
    lom_reference_volume *volume = lom_create_reference_volume(&desc, &error);
    CHECK(volume != nullptr, "%s", error.text);
    lom_free_image(image);
    return volume;
}

/* The sum of the middles of STEPS parts of a voxel over each span that the tree has something in, and a voxel around it
 * on both sides: what is sampled there is a mean of neighbours. */
double depth_by_vdb(const FloatGrid &cloud, openvdb::tools::VolumeRayIntersector<FloatGrid> &walk, const Vec3d &from,
                    const Vec3d &along, double far)
{
    openvdb::tools::GridSampler<FloatGrid, openvdb::tools::BoxSampler> density(cloud);
    if (!walk.setWorldRay(openvdb::math::Ray<double>(from, along, 0, far)))
        return 0;
    double sum = 0, t0 = 0, t1 = 0, end = 0;
    while (walk.march(t0, t1)) {
        double low = std::max(t0 - 2, end);
        const double high = std::max(std::min(t1 + 2, far), low);
        const int parts = 1 + int(std::ceil((high - low) * STEPS));
        const double part = (high - low) / parts;
        for (int i = 0; i < parts; i++)
            sum += part * density.wsSample(from + along * (low + (i + 0.5) * part));
        end = high;
    }
    return EXTINCTION * sum;
}

void depths_are_openvdbs()
{
    FloatGrid::Ptr cloud = make_cloud();
    lom_reference_volume *volume = copy_to_lom(*cloud);
    openvdb::tools::VolumeRayIntersector<FloatGrid> walk(*cloud);
    double worst = 0, squares = 0, total = 0;
    int met = 0;
    for (uint64_t i = 0; i < RAYS; i++) {
        double n[6];
        for (uint64_t k = 0; k < 6; k++)
            n[k] = lom_random_uniform(9, 6 * i + k);
        const Vec3d from(150 * n[0] - 43, 150 * n[1] - 43, -40), to(20 + 24 * n[2], 20 + 24 * n[3], 20 + 24 * n[4]);
        const double far = 200;
        Vec3d along = to - from;
        along.normalize();
        const lom_vec3 origin = { from.x(), from.y(), from.z() }, direction = { along.x(), along.y(), along.z() };
        const double ours = lom_volume_optical_depth(volume, origin, direction, 0, far);
        const double theirs = depth_by_vdb(*cloud, walk, from, along, far);
        const double off = std::fabs(ours - theirs);
        CHECK(off <= 2e-5 * (1 + theirs), "ray %d: %.9g, OpenVDB has %.9g", int(i), ours, theirs);
        worst = std::max(worst, off);
        squares += off * off;
        total += theirs * theirs;
        met += theirs > 0;
    }
    std::printf("  OpenVDB %s: %d of %d rays meet the cloud; largest difference %.2e, RMSE over RMS %.2e\n",
                openvdb::getLibraryAbiVersionString(), met, RAYS, worst, std::sqrt(squares / total));
    CHECK(met > RAYS / 2, "%d rays", met);
    CHECK(std::sqrt(squares / total) <= 1e-5, "%g", std::sqrt(squares / total));
    lom_free_reference_volume(volume);
}

} // namespace

int main(int argc, char **argv)
{
    openvdb::initialize();
    RUN(depths_are_openvdbs);
    return check_result();
}
