"""Each effect in the words of a bench: its name, its process in the pump, and the inspection of parts or meters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from system.description.gap import Gap
from system.effects.effect import EffectId


@dataclass(frozen=True)
class BenchWords:
    """An effect in the words of a bench engineer.

    name: a noun that follows "the cause is" and may be followed by "at the pistons". finding: a sentence without its
    end. Its fields are {place} (a gap in words), {part} (a friction pair or bearing), {stated} (a stated value), {size}
    (the effect's first size) and sizes by the last part of their names, in a form that may follow a colon
    (`diagnosis.report.sizes`). look: one to three sentences, the parts to inspect and their signs of damage, {parts}
    for those of the gap; of a meter, its check.
    """

    name: str
    finding: str
    look: str


PARTS: Mapping[Gap, str] = {
    Gap.PISTON: "pistons with their bores",
    Gap.SLIPPER: "slipper lands with the swash plate",
    Gap.VALVE_PLATE: "block face with the valve plate",
}
"""The parts on both sides of a gap."""

E = EffectId
_FILMS = {
    E.FILM_HEATING: BenchWords(
        "heating of the oil films",
        "The oil films are warmer than the case: shear and throttling heat and thin the oil in them",
        "Feel for hot spots and look for oil varnish or straw-coloured heat tints on block face, slippers and pistons. "
        "Measure the drain's temperature close to the case, not at the tank.",
    ),
    E.VISCOSITY_PRESSURE: BenchWords(
        "thickening of the oil under pressure",
        "The oil thickens under pressure, by {coefficient:per_100_bar} per 100 bar",
        "Nothing is wrong with the pump. Ask the oil's maker for its pressure-viscosity coefficient.",
    ),
    E.SHEAR_THINNING: BenchWords(
        "thinning of the oil by shear",
        "The oil thins by up to {drop:percent} where it is sheared fast",
        "Nothing is wrong with the pump. Check whether a multigrade oil with polymer improvers was filled, and for how "
        "many hours it has run.",
    ),
    E.MIXED_FRICTION: BenchWords(
        "mixed friction",
        "Faces touch where speed and viscosity are too low to keep them apart",
        "Look for polished or scored tracks on slipper faces, the swash plate, block face and piston skirts. Look for "
        "bronze in the drain filter.",
    ),
    E.ELASTIC_OPENING: BenchWords(
        "elastic opening",
        "The film at {place} opens under pressure, by {opening:per_100_bar} of its thickness per 100 bar",
        "Look at {parts}: a crack, a thin or soft wall, a seat that does not bear all round, loose bolts. Check with "
        "marking blue whether the faces bear on their whole width.",
    ),
    E.THERMAL_CLEARANCE: BenchWords(
        "thermal change of the clearance",
        "The clearance at {place} changes by {rate:percent} of itself per K of warming",
        "Check the materials of {parts} against the drawing: a bushing or a replaced part may expand unlike its "
        "partner. Measure the clearance cold and warm.",
    ),
    E.SQUEEZE_PUMPING: BenchWords(
        "pumping by slippers that rise and fall",
        "The slippers rise and fall by {stroke} in each turn and pump oil into the case",
        "Measure the axial play of the slippers under the retainer and of the retainer itself. Look for hammered "
        "marks on the slippers' outer edge and on the retainer's holes.",
    ),
    E.SLIPPER_LIFT: BenchWords(
        "lift of the slippers",
        "The slippers lift or tip off the swash plate at high speed, by up to {ride_height}",
        "Look at the slipper lands: wear on one side of the outer edge shows tipping. Check the retainer's clearance, "
        "the spring that holds it, and the inlet pressure.",
    ),
    E.BLOCK_TIPPING: BenchWords(
        "tipping of the cylinder block",
        "The cylinder block tips on the valve plate at high speed",
        "Look for marks on one side of block face and valve plate, mostly at the outer land. Check the block's spring, "
        "the spline and the shaft's bearings for play.",
    ),
    E.FILM_RUPTURE: BenchWords(
        "rupture of the oil films",
        "The oil films rupture where their pressure falls, and carry less there",
        "Look for pitting by cavitation on the lands, behind the edges in the sense of motion. Check inlet and case "
        "pressure, and the oil for foam.",
    ),
    E.WORN_PROFILE: BenchWords(
        "worn profiles",
        "The walls of the films have another shape than drawn",
        "Trace the profiles of pistons, bores, slippers and block face. Look for rounded edges and run-in lands.",
    ),
}
_FILLING_AND_DRAG = {
    E.ENTRAINED_AIR: BenchWords(
        "air in the oil",
        "Bubbles of air take the place of oil: {void:percent} of the volume at atmospheric pressure",
        "Look for foam in the tank and bubbles in a sight glass of the suction line. Check suction seals, oil level "
        "and the return line's end below the oil.",
    ),
    E.INCOMPLETE_FILLING: BenchWords(
        "incomplete filling of the chambers",
        "The chambers no longer fill at suction at high speed",
        "Check the suction line: filter, valve, length and bends, and the charge pressure at the port. Look for "
        "pitting on the suction side of valve plate and block.",
    ),
    E.CHURNING: BenchWords(
        "churning of oil in the case",
        "The rotating group churns the oil in the case: {factor:times} the drag of a drum",
        "Check whether the case is full, how viscous and warm the oil in it is, and whether a guide or an insert of "
        "the case is missing. With the case drained to half, the torque should fall.",
    ),
    E.SEAL_DRAG: BenchWords(
        "drag of the shaft seal",
        "The shaft seal drags with {torque}",
        "Feel whether the seal or the bearing end is hot, and turn the shaft by hand. Look at the lip, the shaft's "
        "track and whether a tighter seal was fitted.",
    ),
    E.CHARGE_PUMP_DRAG: BenchWords(
        "a charge pump on the shaft",
        "The shaft drives a charge pump too, of {volume}",
        "Look whether a charge or auxiliary pump sits on the same shaft, and at its relief pressure. The torque meter "
        "reads its share as well.",
    ),
    E.PORT_THROTTLING: BenchWords(
        "throttling behind the ports",
        "Passages behind the ports throttle the flow: {factor:times} the loss of the kidneys",
        "Look for narrow fittings, adapters and check valves between the pump's ports and the pressure taps. Check "
        "whether the kidneys are free of burrs and casting sand.",
    ),
    E.COMPRESSION_LOSS: BenchWords(
        "loss of compression energy",
        "{share:percent} of the energy of compressed oil is lost at the ports",
        "Look at the relief grooves of the valve plate: missing, plugged or of the other direction of rotation. Listen "
        "for a hard, loud run.",
    ),
}
_PATHS_AND_PORTS = {
    E.PORT_SHORT_CIRCUIT: BenchWords(
        "an opening from delivery to inlet",
        "Oil flows back from delivery to inlet through an opening of {area} (a hole of {area:hole})",
        "Look at relief and crossover valves: dirt on a seat, a damaged cone. Look at the bridges between the kidneys "
        "of valve plate and block for scores and erosion.",
    ),
    E.LAMINAR_CROSS_LEAK: BenchWords(
        "a narrow gap from delivery to inlet",
        "Oil leaks from delivery to inlet through a narrow gap",
        "Look at the bridges between the kidneys of valve plate and block face: fine scores, an uneven face. Check the "
        "seals between the ports of the end cover.",
    ),
    E.CONTROL_FLOW: BenchWords(
        "oil drawn by the control",
        "The control draws oil from delivery into the case through an opening of {area} (a hole of {area:hole})",
        "Look at the pump control: spool clearance, bleed orifices, seals of the setting piston. Compare with the "
        "control blocked off and its drain measured by itself.",
    ),
    E.NOTCH_EROSION: BenchWords(
        "worn relief grooves",
        "The relief grooves are worn: the ports open {advance} sooner",
        "Look at the ends of the kidneys on the valve plate: relief grooves longer and wider than drawn, with rough, "
        "eroded flanks.",
    ),
    E.SWASH_DROOP: BenchWords(
        "a swash plate that gives way",
        "The swash plate gives way under load, by {rate:angle_per_100_bar} per 100 bar with {play} of play, and the "
        "stroke falls",
        "Measure the swash angle under pressure. Look at the plate's bearings, the setting piston, its rod and the "
        "stop screw for play.",
    ),
    E.LINE_RESONANCE: BenchWords(
        "resonance of the delivery line",
        "The delivery line resonates at one speed, where its meter reads {height:percent_off}",
        "Nothing is wrong with the pump. Move the flow meter or add a damper, and read again at the same speed.",
    ),
}
_METERS = {
    E.TORQUE_OFFSET: BenchWords(
        "zero error of the torque meter",
        "The torque meter reads {zero:off} everywhere: its zero is off",
        "Set the torque meter's zero with the coupling open, cold and warm. Hang a known weight on a lever.",
    ),
    E.TORQUE_GAIN: BenchWords(
        "gain error of the torque meter",
        "The torque meter reads {gain:percent_off}: its gain is off",
        "Calibrate the torque meter with a lever and weights at two loads. Check range and scale factor of the "
        "amplifier.",
    ),
    E.Q_OUT_GAIN: BenchWords(
        "gain error of the delivery flow meter",
        "The delivery flow meter reads {gain:percent_off}: its gain is off",
        "Check the meter's factor and viscosity correction. Compare it with a second meter in series, or with the "
        "inlet's meter at low pressure.",
    ),
    E.Q_IN_GAIN: BenchWords(
        "gain error of the inlet flow meter",
        "The inlet flow meter reads {gain:percent_off}: its gain is off",
        "Check the meter's factor and viscosity correction. Compare it with the delivery's meter at low pressure.",
    ),
    E.Q_CASE_OFFSET: BenchWords(
        "zero error of the drain flow meter",
        "The drain flow meter reads {zero:off} everywhere: its zero is off",
        "Read the drain meter with the pump at rest and the line full. Weigh the drain of a few minutes in a vessel.",
    ),
    E.Q_CASE_DRIFT: BenchWords(
        "drift of the drain flow meter",
        "The drain flow meter drifts, by {drift:off} in the course of the recording",
        "Read the drain meter's zero before and after a run. Repeat the first point at the end.",
    ),
    E.Q_CASE_GAIN: BenchWords(
        "gain error of the drain flow meter",
        "The drain flow meter reads {gain:percent_off}: its gain is off",
        "Weigh the drain of a few minutes in a vessel at two flows. Check the meter's factor at this oil and "
        "temperature.",
    ),
    E.FLOW_LAG: BenchWords(
        "lag of the delivery flow meter",
        "The delivery flow meter lags by {lag}",
        "Check the averaging time of the meter's amplifier. Wait longer at each point, or step the flow and watch how "
        "long the reading takes.",
    ),
    E.P_OUT_OFFSET: BenchWords(
        "zero error of the delivery pressure gauge",
        "The delivery pressure gauge reads {zero:off}: its zero is off",
        "Vent the line and read the gauge. Check whether it is absolute or gauge, and compare it with a dead-weight "
        "tester.",
    ),
    E.T_CASE_OFFSET: BenchWords(
        "error of the case thermometer",
        "The case thermometer reads {zero:off}",
        "Put the thermometer beside a second one in a warm bath. Check that it sits in the flowing drain and not in a "
        "dead corner.",
    ),
    E.T_IN_OFFSET: BenchWords(
        "error of the inlet temperature",
        "The oil at the inlet is not as warm as taken: off by {zero}",
        "Measure the temperature at the inlet. Put the thermometer beside a second one in a warm bath.",
    ),
}
_VALUES = {
    E.FILM_THICKNESS: BenchWords(
        "another film thickness",
        "The film at {place} is {size} thick, not {stated} as stated",
        "Measure {parts}: clearance, height and width of the lands, marks of wear. Check that they are the parts of "
        "the drawing.",
    ),
    E.VISCOSITY_GRADE: BenchWords(
        "another viscosity of the oil",
        "The oil's viscosity is {size:factor} than stated",
        "Take a sample and have its viscosity measured at 40 and 100 degC. Check which grade was filled, and the case "
        "thermometer.",
    ),
    E.BULK_MODULUS: BenchWords(
        "another bulk modulus of the oil",
        "The oil's bulk modulus is {size}, not {stated} as stated",
        "Check the oil for dissolved and free air, and its data sheet for the modulus at this temperature.",
    ),
    E.DEAD_VOLUME: BenchWords(
        "another dead volume",
        "The dead volume of a chamber is {size}, not {stated} as stated",
        "Measure the depth of the bores and the hollow of the pistons against the drawing. Fillers may be missing.",
    ),
    E.FRICTION_COEFFICIENT: BenchWords(
        "another friction coefficient",
        "The friction coefficient of {part} is {size}, not {stated} as stated",
        "Look at the parts of that pair for scores, smeared material and lack of oil. Check the preload of bearings.",
    ),
    E.DISPLACEMENT: BenchWords(
        "another displacement",
        "The displacement is {size:factor} than stated",
        "Check the stop screw of the full stroke and the swash angle, and the pump's size by its plate. Derive the "
        "displacement from readings at low pressure.",
    ),
}
_UNKNOWN = {
    E.UNKNOWN_PHYSICS: BenchWords(
        "a cause outside the catalogue",
        "No effect of the catalogue explains the mismatch",
        "Look for what is special to this pump or bench: added parts, another oil, an unusual line. Compare "
        "with a second pump of the same make.",
    )
}
BENCH_WORDS: Mapping[EffectId, BenchWords] = {
    **_FILMS, **_FILLING_AND_DRAG, **_PATHS_AND_PORTS, **_METERS, **_VALUES, **_UNKNOWN,
}  # fmt: skip
"""Of every id of the catalogue, and of unknown physics."""
