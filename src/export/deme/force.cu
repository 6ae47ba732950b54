// Body of a contact force model for DEM-Engine; the functions it calls are in @PREREQUISITES@, where the law is described.
//
//   auto model = DEMSim.ReadContactForceModel("@FORCE@");
//   model->ReadCustomModelPrerequisitesFile("@PREREQUISITES@");
//   model->SetMustHaveMatProp({});
//   model->SetMustPairwiseMatProp({"mu"});
//   model->SetPerContactWildcards({"x_max_A", "x_max_B", "share_A", "delta_tan_x", "delta_tan_y", "delta_tan_z"});
//   // both files in the folder of user scripts; coefficients of friction: DEMSim.SetMaterialPropertyPair("mu", a, b, 0.3)
//
// Bodies of this law's material against each other, or against rigid triangles and analytical surfaces. Friction: Mindlin's
// spring at the present contact radius, k_t = 8 G/(2 - nu) a a side in series, scaled down with the contact, Coulomb limit.
// No damping, no rolling resistance. Wildcards are single precision: histories are right to 1e-7.
if (overlapDepth > 0) {
    const bool law_flat = BRadius > 0.5f * DEME_HUGE_FLOAT;
    law_side law_A = law_recall(x_max_A), law_B = law_recall(x_max_B);
    double law_share = share_A;
    law_pressed law_now;
    if (law_flat)
        law_now = law_wall(overlapDepth, ARadius, &law_A);
    else
        law_now = law_pair(overlapDepth, ARadius, BRadius, &law_A, &law_B, &law_share);
    x_max_A = (float)law_A.x_max;
    x_max_B = (float)law_B.x_max;
    share_A = (float)law_share;

    float3 law_spin_A = cross(ARotVel, locCPA), law_spin_B = cross(BRotVel, locCPB);
    applyOriQToVector3<float, deme::oriQ_t>(law_spin_A.x, law_spin_A.y, law_spin_A.z, AOriQ.w, AOriQ.x, AOriQ.y, AOriQ.z);
    applyOriQToVector3<float, deme::oriQ_t>(law_spin_B.x, law_spin_B.y, law_spin_B.z, BOriQ.w, BOriQ.x, BOriQ.y, BOriQ.z);
    const float3 law_velocity = (ALinVel + law_spin_A) - (BLinVel + law_spin_B);
    const float3 law_slip = law_velocity - dot(law_velocity, B2A) * B2A;
    float3 law_spring = make_float3(delta_tan_x, delta_tan_y, delta_tan_z) + ts * law_slip;
    law_spring = law_spring - dot(law_spring, B2A) * B2A;

    const float law_normal = (float)law_now.force;
    const float law_stiffness = (float)(@SHEAR@ * (law_flat ? 1.0 : 0.5) * law_now.contact_radius);
    const float law_limit = mu[bodyAMatType][bodyBMatType] * law_normal;
    float3 law_friction = (-law_stiffness) * law_spring;
    const float law_size = length(law_friction);
    if (law_size > law_limit) {
        law_friction = (law_limit / law_size) * law_friction;
        law_spring = (law_limit / law_size) * law_spring;
    }
    force += law_normal * B2A + law_friction;
    delta_tan_x = law_spring.x;
    delta_tan_y = law_spring.y;
    delta_tan_z = law_spring.z;
} else {
    x_max_A = 0;
    x_max_B = 0;
    share_A = 0;
    delta_tan_x = 0;
    delta_tan_y = 0;
    delta_tan_z = 0;
}
