Creator "a program"
Version 1
graph
[
  edge
  [
    source 0
    target 1
  ]
]
