graph
[
  Creator "Gephi"
  directed 0
  node
  [
    id 0
    label ""
    graphics
    [
      x 0.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 1
    label ""
    graphics
    [
      x 1.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 2
    label ""
    graphics
    [
      x 2.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 3
    label ""
    graphics
    [
      x 3.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 4
    label ""
    graphics
    [
      x 4.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 5
    label ""
    graphics
    [
      x 5.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  node
  [
    id 6
    label ""
    graphics
    [
      x 6.5
      y -1.25E-4
      w 10.0
      fill "#c0c0c0"
    ]
  ]
  edge
  [
    id 0
    source 0
    target 1
    value 1.0
  ]
  edge
  [
    id 1
    source 0
    target 2
    value 1.0
  ]
  edge
  [
    id 2
    source 1
    target 2
    value 1.0
  ]
  edge
  [
    id 3
    source 1
    target 3
    value 1.0
  ]
  edge
  [
    id 4
    source 2
    target 3
    value 1.0
  ]
  edge
  [
    id 5
    source 2
    target 4
    value 1.0
  ]
  edge
  [
    id 6
    source 3
    target 4
    value 1.0
  ]
  edge
  [
    id 7
    source 3
    target 5
    value 1.0
  ]
  edge
  [
    id 8
    source 4
    target 5
    value 1.0
  ]
  edge
  [
    id 9
    source 4
    target 6
    value 1.0
  ]
  edge
  [
    id 10
    source 5
    target 6
    value 1.0
  ]
]
