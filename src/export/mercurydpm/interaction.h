// Interaction of MercuryDPM under the contact law described in @FILE@: place it in Kernel/Interactions/NormalForceInteractions,
// beside @FILE@.
#ifndef @CLASS@Interaction_H
#define @CLASS@Interaction_H

#include <iostream>
#include <string>
#include "Interactions/BaseInteraction.h"
#include "Particles/BaseParticle.h"
#include "@FILE@"

/// Normal force of the law; between two particles each side has its history, against a wall the particle alone flattens.
/// An interaction is erased when its bodies no longer overlap, and with it the history.
class @CLASS@Interaction : public virtual BaseInteraction
{
public:
    @CLASS@Interaction(BaseInteractable* P, BaseInteractable* I, unsigned timeStamp)
        : BaseInteraction(P, I, timeStamp)
    {
        clear();
    }

    /// Used for MPI.
    @CLASS@Interaction()
        : BaseInteraction()
    {
        clear();
    }

    void computeNormalForce()
    {
        setRelativeVelocity(getP()->getVelocityAtContact(getContactPoint()) - getI()->getVelocityAtContact(getContactPoint()));
        setNormalRelativeVelocity(Vec3D::dot(getRelativeVelocity(), getNormal()));
        law_pressed pressed = {0.0, 0.0, 0.0, {0.0, 0.0}, 0.0};
        if (getOverlap() > 0.0)
            pressed = press();
        else
            clear();
        setAbsoluteNormalForce(pressed.force);
        setForce(getNormal() * pressed.force);
        setTorque(Vec3D(0.0, 0.0, 0.0));
    }

    Mdouble getElasticEnergy() const override
    {
        const auto* p = dynamic_cast<const BaseParticle*>(getP());
        const auto* i = dynamic_cast<const BaseParticle*>(getI());
        if (getOverlap() <= 0.0 || p == nullptr)
            return 0.0;
        if (i == nullptr)
            return law_elastic_energy(getOverlap(), p->getRadius(), &sides_[0]);
        return law_pair_elastic_energy(getOverlap(), p->getRadius(), i->getRadius(), &sides_[0]);
    }

    /// Largest flattening over radius of each side, and the share of the overlap that the first side takes.
    void write(std::ostream& os) const override
    {
        BaseInteraction::write(os);
        os << " xMax " << sides_[0].x_max << " " << sides_[1].x_max << " share " << share_;
    }

    void read(std::istream& is) override
    {
        BaseInteraction::read(is);
        std::string dummy;
        double first = 0.0, second = 0.0;
        is >> dummy >> first >> second >> dummy >> share_;
        sides_[0] = law_recall(first);
        sides_[1] = law_recall(second);
    }

    std::string getBaseName() const
    {
        return "@CLASS@";
    }

private:
    void clear()
    {
        law_forget(&sides_[0]);
        law_forget(&sides_[1]);
        share_ = 0.0;
    }

    law_pressed press()
    {
        const auto* p = dynamic_cast<const BaseParticle*>(getP());
        const auto* i = dynamic_cast<const BaseParticle*>(getI());
        if (i == nullptr)
            return law_wall(getOverlap(), p->getRadius(), &sides_[0]);
        return law_pair(getOverlap(), p->getRadius(), i->getRadius(), &sides_[0], &sides_[1], &share_);
    }

    law_side sides_[2];
    double share_;
};
#endif
