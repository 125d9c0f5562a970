from .calibration import Calibration as Calibration, calibrate as calibrate
from .checks.check import check_recording as check_recording
from .explain.ranked import Explanation as Explanation
from .finding import DiagnosisResult as DiagnosisResult, diagnose as diagnose
from .next_point.operating_box import BenchBox as BenchBox
from .procedure.next_test import with_next_point as with_next_point
from .procedure.stages import diagnose_study as diagnose_study
from .recording.model import (
    Circuit as Circuit,
    NoteKind as NoteKind,
    RecordedChannel as RecordedChannel,
    Recording as Recording,
    SteadyTable as SteadyTable,
    TraceBlock as TraceBlock,
)
from .recording.reader import read_recording as read_recording
from .report.answer import Look as Look, PlainAnswer as PlainAnswer, plain_answer as plain_answer
from .report.hidden import HiddenEffect as HiddenEffect, hidden_effects as hidden_effects
from .report.json_file import write_diagnosis as write_diagnosis
from .report.text import statement as statement
from .study.acceptance import checked_recording as checked_recording
from .study.model import Study as Study
from .study.prepare import prepare as prepare
from .study.readings import observations as observations
from .thresholds import load_thresholds as load_thresholds
from .verdict.diagnosis import Diagnosis as Diagnosis
