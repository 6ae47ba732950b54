// Stand-in for the kernel of DEM-Engine around a force model: the names a model may use, as the engine documents them, in
// plain C++. It proves that the text compiles and computes; it is not DEM-Engine.
// Arguments: radius of A, radius of B (0: an analytical surface), mass, relative speed, time step, steps.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#define __device__
#define __forceinline__ inline
#define DEME_HUGE_FLOAT 1e15f

struct float3 { float x, y, z; };
struct float4 { float w, x, y, z; };
static float3 make_float3(float x, float y, float z) { return {x, y, z}; }
static float3 operator+(float3 a, float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
static float3 operator-(float3 a, float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
static float3 operator*(float s, float3 a) { return {s * a.x, s * a.y, s * a.z}; }
static float3 &operator+=(float3 &a, float3 b) { return a = a + b; }
static float dot(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static float length(float3 a) { return std::sqrt(dot(a, a)); }
static float3 cross(float3 a, float3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
namespace deme { typedef float oriQ_t; }
template <class T, class Q> static void applyOriQToVector3(T &, T &, T &, Q, Q, Q, Q) {} // bodies are not turned

#include "@PREREQUISITES@"

struct Contact { float x_max_A, x_max_B, share_A, delta_tan_x, delta_tan_y, delta_tan_z; };

static float3 contact_force(double overlapDepth, float ARadius, float BRadius, float3 ALinVel, float3 BLinVel, float ts, Contact &c)
{
    const float3 B2A = {-1.f, 0.f, 0.f}, ARotVel = {0, 0, 0}, BRotVel = {0, 0, 0}, locCPA = {ARadius, 0, 0}, locCPB = {0, 0, 0};
    const float4 AOriQ = {1, 0, 0, 0}, BOriQ = {1, 0, 0, 0};
    const int bodyAMatType = 0, bodyBMatType = 0;
    const float mu[1][1] = {{0.3f}};
    float &x_max_A = c.x_max_A, &x_max_B = c.x_max_B, &share_A = c.share_A;
    float &delta_tan_x = c.delta_tan_x, &delta_tan_y = c.delta_tan_y, &delta_tan_z = c.delta_tan_z;
    float3 force = {0, 0, 0};
    {
#include "@FORCE@"
    }
    return force;
}

int main(int argc, char **argv)
{
    if (argc != 7)
        return 2;
    const double r_a = atof(argv[1]), r_b = atof(argv[2]), mass = atof(argv[3]), dt = atof(argv[5]);
    const int steps = atoi(argv[6]);
    double x = 0.0, v = atof(argv[4]), force = 0.0;
    Contact contact = {0, 0, 0, 0, 0, 0};
    for (int step = 1; step <= steps; step++) {
        v -= 0.5 * dt / mass * force;
        x += dt * v;
        const float3 f = contact_force(x, (float)r_a, r_b > 0.0 ? (float)r_b : DEME_HUGE_FLOAT, make_float3((float)v, 0, 0),
                                       make_float3(0, 0, 0), (float)dt, contact);
        force = -(double)f.x;
        v -= 0.5 * dt / mass * force;
        printf("%d %.17g %.17g %.17g\n", step, x, v, force);
    }
    return 0;
}
