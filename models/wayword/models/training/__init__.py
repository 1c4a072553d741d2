"""Fine-tuning of the translation model: data, augmentation, LoRA on the CPU. Needs the extra ``train``."""
