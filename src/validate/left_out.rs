//! Left out: published impacts that were looked at and are no experiment here, with the reason.

/// A published impact, or a claim about impacts, that is compared with nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LeftOut {
    /// Who published it.
    pub source: &'static str,
    /// What it is about.
    pub of: &'static str,
    /// How much of it was seen.
    pub seen: &'static str,
    /// Why it is no experiment here.
    pub why: &'static str,
}

/// In the order of their sources' years, as far as they are known.
pub const LEFT_OUT: [LeftOut; 14] = [
    LeftOut {
        source: "Wall and others 1990",
        of: "ammonium fluorescein of 2.6 to 6.9 µm on Mo, Si, mica and a polymer, 1 to 100 m/s: e up to 0.71, no bounce below about 1 m/s",
        seen: "abstract",
        why: "Below 20 m/s adhesion decides, and no work of adhesion is printed in what was seen; above, no strength is.",
    },
    LeftOut {
        source: "Tellez-Medina 2010",
        of: "glass bead and granule dropped on a glass plate: e 0.61 and 0.44",
        seen: "abstract",
        why: "Neither the speed nor constants of the granule are stated; a glass bead that loses 63 % of its energy does not do so by what is modelled here.",
    },
    LeftOut {
        source: "Güttler and others 2012 (arXiv 1204.0001)",
        of: "e(V) of all normal impacts published until then, digitised by them",
        seen: "abstract; the files could not be fetched",
        why: "The best collection there is: its numbers were not seen, and nothing is read off a figure here.",
    },
    LeftOut {
        source: "Xie and others 2017 (Scientific Reports, s41598-017-05104-7)",
        of: "aluminium microspheres on sapphire and on aluminium, 50 to 1100 m/s",
        seen: "abstract",
        why: "On sapphire, which is nearly rigid, it would be the experiment for this program: e, flattening and constants stand in figures that were not seen.",
    },
    LeftOut {
        source: "Nanoscale Research Letters 2017 (s11671-017-2410-4)",
        of: "bouncing speed of adhesive spheres, √(C/ρ) (γ⁵/(E²R⁵))^(1/6), C from 0.3 to 60",
        seen: "formula",
        why: "A constant that spans two decades bounds nothing.",
    },
    LeftOut {
        source: "Ghaednia and others 2019, as coded by others",
        of: "F(δ) of hardening spheres, six sets of constants",
        seen: "code",
        why: "The coder notes a misprint in the paper, and the forces lie 7 to 29 % above CalculiX. The theory `ghaednia` is from the paper; finite elements with hardening are compared in the guide.",
    },
    LeftOut {
        source: "Harkavyi and others 2025 (Soft Matter, d4sm01499e)",
        of: "slow compression of solder balls: size, rate and temperature",
        seen: "abstract",
        why: "Numbers were not seen.",
    },
    LeftOut {
        source: "preprint rs-8930301, 2026",
        of: "errors of a simulation of Al on Al, Cu on Cu and Al on Cu of 10 to 30 µm, 50 to 1300 m/s: 20.6 % in e",
        seen: "abstract",
        why: "The error of another’s simulation, without the impacts.",
    },
    LeftOut {
        source: "nelson.mit.edu, page on laser-driven impacts",
        of: "aluminium sphere on aluminium, 605 m/s back at 45 m/s; stays at 805 m/s",
        seen: "text of the page; one shot",
        why: "Size and alloy are not stated. Two deformable bodies are run up to ρV²/Y of 0.1, and this is 3.6 at 276 MPa: refused by name (guide, chapter Measured, has what a rigid wall says).",
    },
    LeftOut {
        source: "the same page",
        of: "silica on a cantilever of alumina, 78 m/s back at 23 m/s",
        seen: "text of the page; one shot",
        why: "The cantilever breaks.",
    },
    LeftOut {
        source: "Sandia TAIS",
        of: "cylinder of OFHC copper of 25.4 by 7.62 mm at 190 m/s",
        seen: "description",
        why: "The Taylor bar of the last experiment but for 0.2 % of the diameter; its final shape is in a data set that was not seen.",
    },
    LeftOut {
        source: "paperexplained.cn, 8d672171",
        of: "balls on a flat: 40 % of the energy lost, time and area as Hertz’s",
        seen: "abstract",
        why: "Materials are not stated.",
    },
    LeftOut {
        source: "Comput. Part. Mech. 2024 (s40571-024-00742-x)",
        of: "elastic waves take less than 3 to 4 % of the energy",
        seen: "introduction; it cites others",
        why: "Taken as a bound of experiment “Elastic waves”, no more.",
    },
    LeftOut {
        source: "Kharaz and Gorham 2000, their e(V)",
        of: "restitution of alumina on thick plates, 0.11 to 5.9 m/s",
        seen: "abstract",
        why: "The points were not seen; the mean pressures of the abstract are experiment “Mean pressure of a yielding plate”.",
    },
];
