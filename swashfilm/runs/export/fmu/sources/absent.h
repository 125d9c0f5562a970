/* SPDX-License-Identifier: MIT
 *
 * Functions of capabilities and interface types that the unit does not have: importers look for all of them. Each
 * returns fmi3Error, or no instance.
 */

#ifndef absent_h
#define absent_h

#define VALUE_REFERENCES fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences
#define NO_VARIABLE(name) return nValueReferences ? refuse(instance, name, "no variable has this type") : fmi3OK;
#define NO_CAPABILITY(name) return refuse(instance, name, "the unit has no such capability");

#define NO_VARIABLES_OF(Type)                                                                       \
    fmi3Status fmi3Get##Type(VALUE_REFERENCES, fmi3##Type values[], size_t nValues)                 \
    {                                                                                               \
        NO_VARIABLE("fmi3Get" #Type)                                                                \
    }                                                                                               \
    fmi3Status fmi3Set##Type(VALUE_REFERENCES, const fmi3##Type values[], size_t nValues)           \
    {                                                                                               \
        NO_VARIABLE("fmi3Set" #Type)                                                                \
    }

NO_VARIABLES_OF(Float32)
NO_VARIABLES_OF(Int8)
NO_VARIABLES_OF(UInt8)
NO_VARIABLES_OF(Int16)
NO_VARIABLES_OF(UInt16)
NO_VARIABLES_OF(Int32)
NO_VARIABLES_OF(UInt32)
NO_VARIABLES_OF(Int64)
NO_VARIABLES_OF(UInt64)
NO_VARIABLES_OF(Boolean)
NO_VARIABLES_OF(String)

fmi3Status fmi3GetBinary(VALUE_REFERENCES, size_t valueSizes[], fmi3Binary values[], size_t nValues)
{
    NO_VARIABLE("fmi3GetBinary")
}

fmi3Status fmi3SetBinary(VALUE_REFERENCES, const size_t valueSizes[], const fmi3Binary values[], size_t nValues)
{
    NO_VARIABLE("fmi3SetBinary")
}

fmi3Status fmi3GetClock(VALUE_REFERENCES, fmi3Clock values[])
{
    NO_VARIABLE("fmi3GetClock")
}

fmi3Status fmi3SetClock(VALUE_REFERENCES, const fmi3Clock values[])
{
    NO_VARIABLE("fmi3SetClock")
}

fmi3Status fmi3GetIntervalDecimal(VALUE_REFERENCES, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
{
    NO_VARIABLE("fmi3GetIntervalDecimal")
}

fmi3Status fmi3GetIntervalFraction(VALUE_REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[])
{
    NO_VARIABLE("fmi3GetIntervalFraction")
}

fmi3Status fmi3GetShiftDecimal(VALUE_REFERENCES, fmi3Float64 shifts[])
{
    NO_VARIABLE("fmi3GetShiftDecimal")
}

fmi3Status fmi3GetShiftFraction(VALUE_REFERENCES, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    NO_VARIABLE("fmi3GetShiftFraction")
}

fmi3Status fmi3SetIntervalDecimal(VALUE_REFERENCES, const fmi3Float64 intervals[])
{
    NO_VARIABLE("fmi3SetIntervalDecimal")
}

fmi3Status fmi3SetIntervalFraction(VALUE_REFERENCES, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    NO_VARIABLE("fmi3SetIntervalFraction")
}

fmi3Status fmi3SetShiftDecimal(VALUE_REFERENCES, const fmi3Float64 shifts[])
{
    NO_VARIABLE("fmi3SetShiftDecimal")
}

fmi3Status fmi3SetShiftFraction(VALUE_REFERENCES, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    NO_VARIABLE("fmi3SetShiftFraction")
}

fmi3Status fmi3GetOutputDerivatives(VALUE_REFERENCES, const fmi3Int32 orders[], fmi3Float64 values[], size_t nValues)
{
    NO_CAPABILITY("fmi3GetOutputDerivatives")
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                        const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                        size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
{
    NO_CAPABILITY("fmi3GetDirectionalDerivative")
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                    const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                    size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
{
    NO_CAPABILITY("fmi3GetAdjointDerivative")
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference valueReference,
                                               size_t *nDependencies)
{
    NO_CAPABILITY("fmi3GetNumberOfVariableDependencies")
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[], fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[], fmi3DependencyKind dependencyKinds[],
                                       size_t nDependencies)
{
    NO_CAPABILITY("fmi3GetVariableDependencies")
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance)
{
    NO_CAPABILITY("fmi3EnterEventMode")
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance)
{
    NO_CAPABILITY("fmi3EnterStepMode")
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance)
{
    NO_CAPABILITY("fmi3EnterConfigurationMode")
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance)
{
    NO_CAPABILITY("fmi3ExitConfigurationMode")
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance)
{
    NO_CAPABILITY("fmi3EvaluateDiscreteStates")
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation, fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged, fmi3Boolean *nextEventTimeDefined,
                                    fmi3Float64 *nextEventTime)
{
    NO_CAPABILITY("fmi3UpdateDiscreteStates")
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage)
{
    const Unit none = {.environment = instanceEnvironment, .log = logMessage};
    refuse(&none, "fmi3InstantiateModelExchange", "the unit is for co-simulation alone");
    return NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instanceName, fmi3String instantiationToken,
                                               fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                               fmi3InstanceEnvironment instanceEnvironment,
                                               fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
                                               fmi3LockPreemptionCallback lockPreemption,
                                               fmi3UnlockPreemptionCallback unlockPreemption)
{
    const Unit none = {.environment = instanceEnvironment, .log = logMessage};
    refuse(&none, "fmi3InstantiateScheduledExecution", "the unit is for co-simulation alone");
    return NULL;
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance)
{
    NO_CAPABILITY("fmi3EnterContinuousTimeMode")
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode, fmi3Boolean *terminateSimulation)
{
    NO_CAPABILITY("fmi3CompletedIntegratorStep")
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    NO_CAPABILITY("fmi3SetTime")
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates)
{
    NO_CAPABILITY("fmi3SetContinuousStates")
}

#define NO_STATES(name)                                                                             \
    fmi3Status fmi3Get##name(fmi3Instance instance, fmi3Float64 values[], size_t nValues)           \
    {                                                                                               \
        NO_CAPABILITY("fmi3Get" #name)                                                              \
    }
#define NO_NUMBER(name)                                                                             \
    fmi3Status fmi3Get##name(fmi3Instance instance, size_t *number)                                 \
    {                                                                                               \
        NO_CAPABILITY("fmi3Get" #name)                                                              \
    }

NO_STATES(ContinuousStateDerivatives)
NO_STATES(EventIndicators)
NO_STATES(ContinuousStates)
NO_STATES(NominalsOfContinuousStates)
NO_NUMBER(NumberOfEventIndicators)
NO_NUMBER(NumberOfContinuousStates)

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime)
{
    NO_CAPABILITY("fmi3ActivateModelPartition")
}

#endif
