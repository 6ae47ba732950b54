// Species of MercuryDPM for the contact law described in @FILE@: place it in Kernel/Species/NormalForceSpecies. Use it as
//     typedef Species<@CLASS@NormalSpecies> @CLASS@Species;                          or with friction
//     typedef Species<@CLASS@NormalSpecies, SlidingFrictionSpecies> @CLASS@SlidingFrictionSpecies;
// The law's constants are compiled in: it has no parameters to set or to mix, and both bodies are of its material.
#ifndef @CLASS@NormalSpecies_H
#define @CLASS@NormalSpecies_H

#include <iostream>
#include <string>
#include "Species/NormalForceSpecies/BaseNormalForce.h"
#include "Interactions/NormalForceInteractions/@CLASS@Interaction.h"

class @CLASS@NormalSpecies : public BaseNormalForce
{
public:
    typedef @CLASS@Interaction InteractionType;

    void read(std::istream&)
    {
    }

    void write(std::ostream&) const
    {
    }

    std::string getBaseName() const
    {
        return "@CLASS@";
    }

    void mix(@CLASS@NormalSpecies*, @CLASS@NormalSpecies*)
    {
    }
};
#endif
