//! The C functions of the FMU by name, with their weights in random calls. A test compares the list with the library's exports.

macro_rules! functions {
    ($($function:ident $weight:literal)+) => {
        /// A C function of the FMU.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[allow(non_camel_case_types, missing_docs)] // FMI's names
        pub enum Function { $($function),+ }

        impl Function {
            /// All functions.
            pub const ALL: &[Self] = &[$(Self::$function),+];

            /// Name of the C function.
            pub fn name(self) -> &'static str {
                match self { $(Self::$function => stringify!($function)),+ }
            }

            /// Relative frequency of calls to the function.
            pub fn weight(self) -> usize {
                match self { $(Self::$function => $weight),+ }
            }
        }
    };
}

functions! {
    fmi2GetTypesPlatform 1
    fmi2GetVersion 1
    fmi2Instantiate 2
    fmi2FreeInstance 1
    fmi2SetDebugLogging 3
    fmi2SetupExperiment 4
    fmi2EnterInitializationMode 4
    fmi2ExitInitializationMode 4
    fmi2Terminate 1
    fmi2Reset 1
    fmi2GetReal 20
    fmi2GetInteger 5
    fmi2GetBoolean 5
    fmi2GetString 3
    fmi2SetReal 20
    fmi2SetInteger 5
    fmi2SetBoolean 5
    fmi2SetString 3
    fmi2GetFMUstate 6
    fmi2SetFMUstate 6
    fmi2FreeFMUstate 5
    fmi2SerializedFMUstateSize 5
    fmi2SerializeFMUstate 5
    fmi2DeSerializeFMUstate 12
    fmi2GetDirectionalDerivative 15
    fmi2EnterEventMode 6
    fmi2NewDiscreteStates 10
    fmi2EnterContinuousTimeMode 15
    fmi2CompletedIntegratorStep 20
    fmi2SetTime 15
    fmi2SetContinuousStates 15
    fmi2GetDerivatives 15
    fmi2GetEventIndicators 15
    fmi2GetContinuousStates 10
    fmi2GetNominalsOfContinuousStates 4
    fmi2SetRealInputDerivatives 8
    fmi2GetRealOutputDerivatives 15
    fmi2DoStep 40
    fmi2CancelStep 2
    fmi2GetStatus 4
    fmi2GetRealStatus 4
    fmi2GetIntegerStatus 2
    fmi2GetBooleanStatus 3
    fmi2GetStringStatus 3
}
