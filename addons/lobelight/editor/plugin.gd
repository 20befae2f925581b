@tool
extends EditorPlugin
## The editor's side of Lobelight.
##
## The types of the run time register themselves by their class names, and the
## baker by the native library; so far nothing else has to be added to the editor.
