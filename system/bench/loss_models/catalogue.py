"""The loss models by name, as readings ask for them."""

from collections.abc import Mapping

from system.bench.loss_models.mccandlish_dorey import MCCANDLISH_DOREY
from system.bench.loss_models.model import LossModel, LossModelName
from system.bench.loss_models.polynomials import ivantysyn
from system.bench.loss_models.schlosser import SCHLOSSER
from system.bench.loss_models.wilson import WILSON
from system.bench.loss_models.zarotti_nevegna import ZAROTTI_NEVEGNA

LOSS_MODELS: Mapping[LossModelName, LossModel] = {
    model.name: model for model in (WILSON, SCHLOSSER, MCCANDLISH_DOREY, ZAROTTI_NEVEGNA, ivantysyn())
}
"""All but Polymod, whose orders hang on the readings: `orders.polymod_for`."""
