/* SPDX-License-Identifier: MIT
 *
 * The functions of FMI 3.0 for co-simulation of a pump by its operating map. The pump has no states: its outputs are
 * those at its present inputs. map.h is written by `swashfilm export --to fmu`; fmi3Functions.h is the importer's.
 */

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "map.h"

#ifndef FMI3_FUNCTION_PREFIX
#define FMI3_FUNCTION_PREFIX MODEL_PREFIX
#endif
#include "fmi3Functions.h"

#include "pump.h"

/* Value references: the time, the inputs of the map, the outputs. */
enum { TIME, FIRST_INPUT, FIRST_OUTPUT = FIRST_INPUT + INPUTS, REFERENCES = FIRST_OUTPUT + OUTPUTS };

typedef struct {
    double time;
    double inputs[INPUTS];
    double outputs[OUTPUTS];
    bool current;          /* the outputs are those of the inputs */
    bool outside[INPUTS];  /* inputs beyond the map when outputs were last computed */
} State;

typedef struct {
    State state;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
    bool warns;
} Unit;

static void say(const Unit *unit, fmi3Status status, const char *format, ...)
{
    char text[400];
    va_list values;
    if (!unit->log || (status == fmi3Warning && !unit->warns))
        return;
    va_start(values, format);
    vsnprintf(text, sizeof text, format, values);
    va_end(values);
    unit->log(unit->environment, status, status == fmi3Warning ? "logStatusWarning" : "logStatusError", text);
}

static fmi3Status refuse(const Unit *unit, const char *where, const char *why)
{
    say(unit, fmi3Error, "%s: %s", where, why);
    return fmi3Error;
}

#include "absent.h"

static void start(State *state)
{
    memset(state, 0, sizeof *state);
    for (size_t k = 0; k < INPUTS; ++k)
        state->inputs[k] = AXIS[k].start;
}

/* Compute the outputs at the inputs, each held at the edge of the map that it exceeds: fmi3Warning, and a message when
 * an input leaves the map. */
static fmi3Status evaluate(Unit *unit)
{
    State *state = &unit->state;
    fmi3Status status = fmi3OK;
    double place[INPUTS];
    for (size_t k = 0; k < INPUTS; ++k) {
        const Axis *axis = &AXIS[k];
        const double value = state->inputs[k];
        const bool outside = value < axis->lower - axis->slack || value > axis->upper + axis->slack;
        if (outside && !state->outside[k])
            say(unit, fmi3Warning, "%s is %.6g %s at %.6g s, beyond the map, %.6g .. %.6g %s: held at its edge",
                axis->name, shown(axis, value), axis->unit, state->time, shown(axis, axis->lower),
                shown(axis, axis->upper), axis->unit);
        if (outside)
            status = fmi3Warning;
        state->outside[k] = outside;
        place[k] = value < axis->lower ? axis->lower : value > axis->upper ? axis->upper : value;
    }
    pump(place, state->outputs);
    state->current = true;
    return status;
}

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[])
{
    Unit *unit = instance;
    if (nCategories == 0)
        unit->warns = loggingOn;
    for (size_t k = 0; k < nCategories; ++k) {
        if (strcmp(categories[k], "logStatusWarning") == 0)
            unit->warns = loggingOn;
        else if (strcmp(categories[k], "logStatusError") != 0) /* errors are always logged */
            return refuse(unit, "fmi3SetDebugLogging", "categories are logStatusWarning and logStatusError");
    }
    return fmi3OK;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate)
{
    Unit given = {.environment = instanceEnvironment, .log = logMessage, .warns = loggingOn};
    if (!instantiationToken || strcmp(instantiationToken, TOKEN) != 0) {
        refuse(&given, "instantiationToken", "not that of the map in this unit");
        return NULL;
    }
    if (eventModeUsed || nRequiredIntermediateVariables > 0) {
        refuse(&given, "fmi3InstantiateCoSimulation", "the unit has neither event mode nor intermediate variables");
        return NULL;
    }
    Unit *unit = malloc(sizeof *unit);
    if (!unit) {
        refuse(&given, "fmi3InstantiateCoSimulation", "no memory");
        return NULL;
    }
    start(&given.state);
    *unit = given;
    return unit;
}

void fmi3FreeInstance(fmi3Instance instance)
{
    free(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime)
{
    ((Unit *)instance)->state.time = startTime;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    return evaluate(instance);
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    start(&((Unit *)instance)->state);
    return fmi3OK;
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          fmi3Float64 values[], size_t nValues)
{
    Unit *unit = instance;
    State *state = &unit->state;
    fmi3Status status = fmi3OK;
    if (nValues != nValueReferences)
        return refuse(unit, "fmi3GetFloat64", "every variable has one value");
    for (size_t k = 0; k < nValues; ++k) {
        const fmi3ValueReference reference = valueReferences[k];
        if (reference >= REFERENCES)
            return refuse(unit, "fmi3GetFloat64", "a value reference that the unit does not have");
        if (reference >= FIRST_OUTPUT && !state->current)
            status = evaluate(unit);
        values[k] = reference == TIME          ? state->time
                    : reference < FIRST_OUTPUT ? state->inputs[reference - FIRST_INPUT]
                                               : state->outputs[reference - FIRST_OUTPUT];
    }
    return status;
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          const fmi3Float64 values[], size_t nValues)
{
    Unit *unit = instance;
    if (nValues != nValueReferences)
        return refuse(unit, "fmi3SetFloat64", "every variable has one value");
    for (size_t k = 0; k < nValues; ++k) {
        const size_t input = valueReferences[k] - FIRST_INPUT;
        if (input >= INPUTS || AXIS[input].levels == 1)
            return refuse(unit, "fmi3SetFloat64", "a value reference that is no input");
        if (!isfinite(values[k]))
            return refuse(unit, AXIS[input].name, "not a finite number");
        unit->state.inputs[input] = values[k];
        unit->state.current = false;
    }
    return fmi3OK;
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    if (!*FMUState && !(*FMUState = malloc(sizeof(State))))
        return refuse(instance, "fmi3GetFMUState", "no memory");
    memcpy(*FMUState, &((Unit *)instance)->state, sizeof(State));
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState)
{
    memcpy(&((Unit *)instance)->state, FMUState, sizeof(State));
    return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState)
{
    free(*FMUState);
    *FMUState = NULL;
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size)
{
    *size = sizeof(State);
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[], size_t size)
{
    if (size < sizeof(State))
        return refuse(instance, "fmi3SerializeFMUState", "fewer bytes than fmi3SerializedFMUStateSize states");
    memcpy(serializedState, FMUState, sizeof(State));
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState)
{
    if (size != sizeof(State))
        return refuse(instance, "fmi3DeserializeFMUState", "not the bytes of a state of this unit");
    if (!*FMUState && !(*FMUState = malloc(sizeof(State))))
        return refuse(instance, "fmi3DeserializeFMUState", "no memory");
    memcpy(*FMUState, serializedState, sizeof(State));
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded,
                      fmi3Boolean *terminateSimulation, fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime)
{
    Unit *unit = instance;
    *eventHandlingNeeded = *terminateSimulation = *earlyReturn = fmi3False;
    *lastSuccessfulTime = unit->state.time;
    if (!(communicationStepSize > 0.0))
        return refuse(unit, "fmi3DoStep", "a communication step size that is not above 0");
    *lastSuccessfulTime = unit->state.time = currentCommunicationPoint + communicationStepSize;
    return evaluate(unit);
}
