extends Node3D

@export var tables: LobeTableSet
