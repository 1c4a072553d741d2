"""What a training run is made of: every number that its result depends on."""

from pydantic import BaseModel, ConfigDict, Field


class Recipe(BaseModel):
    """Hyperparameters of a fine-tuning run. The defaults are those of the adapter that ships with Wayword.

    Attributes:
        rank: Rank of the LoRA matrices.
        alpha: LoRA scale; the adapter's product is multiplied by alpha / rank.
        frozen_layers: Number of lower transformer blocks without an adapter.
        learning_rate: Peak learning rate of AdamW, reached after the warm-up, from where it falls as a cosine.
        warmup_steps: Steps of linear warm-up.
        weight_decay: Of AdamW.
        gradient_clip: Largest norm of a step's gradient.
        epochs: Number of passes over the hand-written sentences; each pass augments them anew.
        batch_size: Instructions in a step.
        scene_share: Share of the instructions spoken on the town map to a parked vehicle, the default scene.
        structure_share: Share of the instructions whose loss counts a program's key words too, which the grammar
            forces. The rest learns where there is a choice.
        seed: Of everything random.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    rank: int = Field(default=16, ge=1)
    alpha: float = Field(default=32.0, gt=0)
    frozen_layers: int = Field(default=6, ge=0)
    learning_rate: float = Field(default=1.2e-3, gt=0)
    warmup_steps: int = Field(default=40, ge=0)
    weight_decay: float = Field(default=0.01, ge=0)
    gradient_clip: float = Field(default=1.0, gt=0)
    epochs: int = Field(default=3, ge=1)
    batch_size: int = Field(default=24, ge=1)
    scene_share: float = Field(default=0.5, ge=0, le=1)
    structure_share: float = Field(default=0.15, ge=0, le=1)
    seed: int = 0
